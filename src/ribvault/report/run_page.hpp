// The run page: one self-contained HTML file on which one can walk through the layers of one run, or of two side by
// side.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "ribvault/report/layer_shapes.hpp"

namespace ribvault {

/// Writes the page piece by piece, so that memory does not depend on the number of layers. The page needs no network
/// and no other file; its parts are in src/page. Layers travel as one deflated stream in base64.
///
///     RunPage page([&](std::string_view text) { file.write(text); });
///     page.begin_run();
///     for (...) page.add_layer(numbers, packed_shapes(shapes));   // from the bed upwards
///     page.end_run(facts);
///     page.finish();
class RunPage {
public:
    /// Writes everything that comes before the runs.
    explicit RunPage(std::function<void(std::string_view)> take);
    ~RunPage();
    RunPage(const RunPage&) = delete;
    RunPage& operator=(const RunPage&) = delete;

    void begin_run();
    /// `record`: page_record of the next layer from the bed upwards.
    void add_layer(std::string_view record);
    /// `facts`: JSON object with what belongs to the whole run; src/page/run.js reads it.
    void end_run(std::string_view facts);
    /// Writes the rest. Precondition: every run has ended.
    void finish();

private:
    class Stream;
    std::function<void(std::string_view)> take_;
    std::unique_ptr<Stream> stream_;  ///< of the run that has begun
    int runs_ = 0;
};

/// One layer as RunPage::add_layer takes it: its numbers, a JSON object, and its packed geometry.
std::string page_record(std::string_view numbers, std::string_view geometry);

/// JSON for a script element: no text in it can end the element.
std::string script_safe(std::string json);

}  // namespace ribvault
