// The layers file of a run: its settings and totals, then the geometry of every layer, one JSON object a line.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "ribvault/report/layer_shapes.hpp"
#include "ribvault/report/run_report.hpp"

namespace ribvault {

inline constexpr const char* layers_schema = "ribvault-layers/1";

/// The first line, without its line end: schema "ribvault-layers/1" (docs/layers-file.md,
/// docs/layers-file.schema.json).
std::string layers_header(const RunReport& report);

/// The line of one layer, without its line end: the layer's numbers as in the report, and `shapes` (shapes_json).
std::string layers_line(const LayerReport& layer, const std::string& shapes);

/// What the run page is told of the whole run (RunPage::end_run). `header`: the first line of its layers file.
std::string page_facts(const std::string& header);

/// A layers file, read line by line; memory does not depend on the number of layers. Throws Error (unreadable) with the
/// file, the line and what is wrong: no such file, of another kind or version, no JSON, a field that is missing or no
/// number where there should be one, a layer out of order, fewer layers than the first line says.
class LayersFile {
public:
    explicit LayersFile(std::filesystem::path file);

    const std::string& header() const { return header_; }
    int layer_count() const { return layer_count_; }

    struct Layer {
        std::string numbers;  ///< all but the geometry, a JSON object
        LayerShapes shapes;
    };
    /// The next layer from the bed upwards; false after the last one.
    bool next(Layer& layer);

private:
    [[noreturn]] void fail(const std::string& what) const;
    bool read_line(std::string& line);

    std::filesystem::path path_;
    std::ifstream in_;
    std::string header_;
    int layer_count_ = 0, line_ = 0;
};

}  // namespace ribvault
