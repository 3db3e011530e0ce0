#include "ribvault/pipeline/shape_outputs.hpp"

#include "ribvault/report/layers_file.hpp"
#include "ribvault/report/report_members.hpp"
#include "ribvault/report/run_page.hpp"

namespace ribvault {

void ShapeOutputs::open(const std::optional<std::filesystem::path>& layers,
                        const std::optional<std::filesystem::path>& page) {
    if (layers) layers_.emplace(Output{AtomicFile(*layers), {}});
    if (page) page_.emplace(Output{AtomicFile(*page), {}});
}

void ShapeOutputs::add(const LayerReport& layer, const std::string& shapes, const std::string& packed) {
    if (layers_) layers_->spool.add(layers_line(layer, shapes) + '\n');
    if (page_) page_->spool.add(page_record(layer_json(layer), packed));
}

void ShapeOutputs::write(const RunReport& report) {
    if (!layers_ && !page_) return;
    const std::string header = layers_header(report);
    if (layers_) {
        layers_->file.write(header + '\n');
        layers_->spool.replay_backwards([&](std::string_view line) { layers_->file.write(line); });
        layers_->file.finish();
    }
    if (!page_) return;
    RunPage page([&](std::string_view text) { page_->file.write(text); });
    page.begin_run();
    page_->spool.replay_backwards([&](std::string_view record) { page.add_layer(record); });
    page.end_run(page_facts(header));
    page.finish();
    page_->file.finish();
}

void ShapeOutputs::commit() {
    if (layers_) layers_->file.commit();
    if (page_) page_->file.commit();
}

}  // namespace ribvault
