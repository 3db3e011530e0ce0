#include "ribvault/pipeline/make_page.hpp"

#include <algorithm>
#include <fstream>

#include "ribvault/error.hpp"
#include "ribvault/output_file.hpp"
#include "ribvault/pipeline/check_outputs.hpp"
#include "ribvault/report/layers_file.hpp"
#include "ribvault/report/print_page.hpp"
#include "ribvault/report/run_page.hpp"

namespace ribvault {
namespace {

/// A line of G-code begins with no brace; files that cannot be read at all are refused by read_gcode.
bool is_json(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    char first = 0;
    return in >> first && first == '{';
}

void append_layers(const PageJob& job, const std::filesystem::path& file, RunPage& page) {
    LayersFile layers(file);
    page.begin_run();
    LayersFile::Layer layer;
    while (layers.next(layer)) {
        end_if(job.rules.stop);
        page.add_layer(page_record(layer.numbers, packed_shapes(layer.shapes)));
    }
    page.end_run(page_facts(layers.header()));
}

void append_gcode(const PageJob& job, const std::filesystem::path& file, RunPage& page) {
    VerifyJob verify = job.rules;
    verify.gcode = file;
    verify.report.reset(), verify.svg.reset(), verify.html.reset();
    const JudgedPrint judged = judged_print(verify);
    append_print(page, judged.print, judged.report);
}

}  // namespace

void make_page(const PageJob& job) {
    if (job.runs.empty() || job.runs.size() > 2)
        throw Error(ErrorKind::usage, "a page shows one run or two, not " + std::to_string(job.runs.size()));
    if (!job.rule_given.empty() && std::all_of(job.runs.begin(), job.runs.end(), is_json))
        throw Error(ErrorKind::usage, job.rule_given + " has no effect: layers files carry their verdicts");
    check_outputs(job.runs, {{"--output", job.page}});
    AtomicFile file(job.page);
    RunPage page([&file](std::string_view text) { file.write(text); });
    for (const std::filesystem::path& run : job.runs)
        is_json(run) ? append_layers(job, run, page) : append_gcode(job, run, page);
    page.finish();
    end_if(job.rules.stop);
    file.commit();
}

}  // namespace ribvault
