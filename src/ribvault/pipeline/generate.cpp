#include "ribvault/pipeline/generate.hpp"

#include <algorithm>
#include <deque>
#include <memory>

#include "ribvault/error.hpp"
#include "ribvault/mesh/orient_mesh.hpp"
#include "ribvault/mesh/read_mesh.hpp"
#include "ribvault/output_file.hpp"
#include "ribvault/pipeline/check_bed.hpp"
#include "ribvault/pipeline/check_outputs.hpp"
#include "ribvault/pipeline/choose_supports.hpp"
#include "ribvault/pipeline/finish_layer.hpp"
#include "ribvault/pipeline/layer_spool.hpp"
#include "ribvault/pipeline/outside_room.hpp"
#include "ribvault/pipeline/prove_layer.hpp"
#include "ribvault/pipeline/shape_outputs.hpp"
#include "ribvault/pipeline/thread_limit.hpp"
#include "ribvault/print/gcode_header.hpp"
#include "ribvault/print/gcode_text.hpp"
#include "ribvault/print/thumbnail.hpp"
#include "ribvault/print/write_gcode.hpp"
#include "ribvault/report/number_text.hpp"
#include "ribvault/report/write_mesh.hpp"

namespace ribvault {
namespace {

class Run {
public:
    explicit Run(const Job& job) : job_(job), start_(Time::now()) {}

    RunReport execute() {
        job_.settings.check();
        job_.tracks.check(job_.settings.nozzle);
        check_printer(job_.printer);
        std::vector<std::filesystem::path> inputs = job_.settings_files;
        inputs.push_back(job_.model);
        check_outputs(inputs,
                      {{"--output", job_.gcode},
                       {"--report", job_.report},
                       {"--mesh", job_.mesh},
                       {"--layers", job_.layers},
                       {"--html", job_.html}},
                      job_.svg);
        report_.version = RIBVAULT_VERSION;
        report_.input_path = job_.model.string();
        report_.tracks = job_.tracks;
        report_.printer = job_.printer;
        read();
        const Slicer slicer(mesh_, report_.placement, job_.settings);
        check_layers(slicer);
        open_outputs(slicer.layer_count());
        times_["read"] = seconds_since(start_);
        std::optional<OutsideRoom> room;
        if (job_.settings.outside()) {
            const auto from = Time::now();
            room.emplace(slicer, support_frame(mesh_, report_.placement, job_.settings), job_.settings, job_.threads,
                         job_.stop);
            if (job_.settings.bed_only) times_["ways"] = seconds_since(from);
        }
        const OutsideRoom* outside = room ? &*room : nullptr;
        choose(slicer, outside);

        LayerFinisher finisher(slicer, job_, folder_ ? &*folder_ : nullptr);
        const auto finish = [&](const SweptLayer& layer, const LayerMaterial* below) -> std::shared_ptr<void> {
            return std::make_shared<LayerOutput>(finisher.finish(layer, below));
        };
        const auto collect = [&](const SweptLayer&, std::shared_ptr<void> output) {
            collect_layer(std::static_pointer_cast<LayerOutput>(output));
        };
        std::function<LayerSupports(std::size_t)> made;
        if (chosen_.supports) made = [&](std::size_t depth) { return chosen_.supports->at(chosen_.sweep, depth); };
        times_.merge(
            sweep_layers(slicer, job_.settings, job_.tracks, job_.threads, finish, collect, job_.stop, outside, made));
        times_.erase("finish");  // its parts are counted one by one
        while (!waiting_.empty()) join();
        times_.merge(finisher.seconds());
        times_["paths"] += joining_.seconds();
        write_outputs();
        return std::move(report_);
    }

private:
    void read() {
        mesh_ = read_mesh(job_.model);
        report_.placement = place(mesh_, job_.placement);
        check_bed(mesh_, report_.placement, job_.settings, job_.tracks, job_.printer);
        report_.input = examine(mesh_, report_.placement);
        if (report_.input.unbalanced_edges == 0) return;
        if (const std::size_t turned = orient_consistently(mesh_); turned > 0) {
            job_.warn(job_.model.string() + ": " + std::to_string(turned) +
                      " triangles faced the wrong way and were turned over");
            report_.input = examine(mesh_, report_.placement);
        }
    }

    void check_layers(const Slicer& slicer) {
        if (slicer.layer_count() == 0)
            throw Error(ErrorKind::does_not_fit, job_.model.string() + ": no layer meets the model, which is " +
                                                     std::to_string(report_.input.size_mm[2]) +
                                                     " mm high; scale it up or use thinner layers");
        if (const auto& size = report_.input.size_mm; *std::max_element(size.begin(), size.end()) < 5)
            job_.warn(job_.model.string() + " is only " + fixed(size[0], 2) + " x " + fixed(size[1], 2) + " x " +
                      fixed(size[2], 2) + " mm; is it in inches (--scale 25.4) or metres (--scale 1000)?");
        const Settings& settings = job_.settings;
        check_height(slicer.layer_count(), settings, job_.printer);
        const auto warn_if_higher = [&](const char* what, Unit height, Unit width) {
            if (height > width)
                job_.warn(what + millimetres(height) + " mm high, more than its tracks are wide (" +
                          millimetres(width) + " mm): such tracks hardly stick to what is below");
        };
        warn_if_higher("the first layer is ", settings.first_layer_height, job_.tracks.width_on(0, settings.nozzle));
        if (slicer.layer_count() > 1) warn_if_higher("a layer is ", settings.layer_height, settings.support_width);
        if (report_.input.closed()) return;
        job_.warn(job_.model.string() + ": the mesh is not closed (" + std::to_string(report_.input.boundary_edges) +
                  " boundary edges); its slices are closed over gaps up to --max-gap");
        require_closed_contours(slicer, job_.settings);
    }

    /// Settles what the settings leave open.
    void choose(const Slicer& slicer, const OutsideRoom* room) {
        const auto from = Time::now();
        chosen_ = sweep_candidates(slicer, job_.settings, job_.threads, job_.stop, room, job_.choosing);
        report_.candidates = chosen_.candidates;
        if (!report_.candidates.empty()) {
            job_.settings.quarter_bonus = report_.candidates.front().quarter_bonus,
            job_.settings.seed = report_.candidates.front().seed;
            times_["choose"] = seconds_since(from);
        }
        report_.settings = job_.settings;
    }

    void open_outputs(int layers) {
        if (job_.gcode) {
            gcode_.emplace(*job_.gcode);
            spool_.emplace();
        }
        if (job_.report) json_.emplace(*job_.report);
        shapes_.open(job_.layers, job_.html);
        if (job_.mesh) {
            const std::string format = job_.mesh->extension().string();
            as_3mf_ = format == ".3mf" || format == ".3MF";
            if (!as_3mf_ && format != ".stl" && format != ".STL")
                throw Error(ErrorKind::usage, "--mesh " + job_.mesh->string() + ": the name must end in .stl or .3mf");
            walls_.emplace(*job_.mesh);
            if (!as_3mf_) walls_->write(stl_header(0));
        }
        if (job_.svg) folder_.emplace(*job_.svg);
        total_ = layers;
        job_.progress(0, total_);
    }

    /// Layers come from the top. Each waits for the one below it, to which it is joined then, and for that whose
    /// external supports hold it up.
    void collect_layer(std::shared_ptr<LayerOutput> next) {
        LayerOutput& output = *next;
        if (waiting_.empty())
            end_of_layers_ = gcode_end_of_layers(output.text, job_.printer, output.text.statistics);
        else
            waiting_.back()->report.print = output.print_above;
        for (const LayerOutput::OverGap& over : output.over_gap)
            for (const auto& layer : waiting_)
                if (layer->report.layer == over.layer)
                    add_verdict(over.verdict, layer->report.verdict), add_verdict(over.print, layer->report.print);
        if (output.picture) svgs_.push_back(std::move(*output.picture));
        if (walls_) {
            facets_ += static_cast<std::uint32_t>(output.walls.size() / 50);
            if (as_3mf_)
                kept_walls_ += output.walls;
            else
                walls_->write(output.walls);
        }
        if (!output.box.empty()) box_.add(output.box.lo), box_.add(output.box.hi);
        waiting_.push_back(std::move(next));
        if (waiting_.size() > static_cast<std::size_t>(job_.settings.support_gap_layers) + 1) join();
        job_.progress(static_cast<int>(report_.layers.size() + waiting_.size()), total_);
    }

    /// Writes the uppermost layer that waits, with the way to it from the one below (under layer 0 there is none).
    void join() {
        const std::shared_ptr<LayerOutput> uppermost = std::move(waiting_.front());
        waiting_.pop_front();
        LayerOutput& output = *uppermost;
        const LayerText* below = waiting_.empty() ? nullptr : &waiting_.front()->text;
        PrintStatistics& p = output.text.statistics;
        joining_.measure([&] {
            const std::string joint = gcode_joint(below, output.text, output.map, job_.settings, job_.printer, p);
            if (spool_) spool_->add(joint + output.text.body);
        });
        LayerReport& r = output.report;
        r.travels = p.travels, r.travel_mm = p.travel, r.open_air_mm = p.open_air;
        r.retractions = p.retractions, r.detours = p.detours;
        r.prime_surplus_mm3 = p.prime_surplus * filament_area(job_.printer);
        r.print_seconds = p.seconds;
        shapes_.add(r, output.shapes, output.packed);
        report_.layers.push_back(std::move(output.report));
    }

    std::string thumbnails() const {
        std::vector<std::array<Corner, 3>> triangles;
        const Placement& placed = report_.placement;
        for (Eigen::Index t = 0; t < mesh_.triangles.cols(); ++t) {
            triangles.emplace_back();
            for (Eigen::Index c = 0; c < 3; ++c)
                for (std::size_t k = 0; k < 3; ++k)
                    triangles.back()[static_cast<std::size_t>(c)][k] =
                        placed.sign[k] * mesh_.vertices(placed.axis[k], mesh_.triangles(c, t));
        }
        std::string text;
        for (const auto& [width, height] : thumbnail_sizes(job_.printer.thumbnails))
            text += thumbnail_comments(thumbnail_png(triangles, width, height), width, height);
        return text;
    }

    void write_outputs() {
        sum_up(report_);
        if (report_.totals.shell_volume_mm3 <= 0)
            throw Error(ErrorKind::bad_geometry,
                        job_.model.string() + ": the mesh encloses no volume; is it a surface without thickness?");
        if (report_.totals.extruded_mm3 <= 0)
            throw Error(ErrorKind::does_not_fit,
                        job_.model.string() + ": nothing of it has room for a track, so nothing would be printed (" +
                            std::to_string(report_.totals.thin_places) +
                            " places are too narrow); scale it up or use a smaller nozzle");
        const auto from = Time::now();
        if (gcode_) {
            const PrintFacts facts{total_,
                                   report_.totals.print_seconds,
                                   report_.totals.filament_mm,
                                   box_,
                                   to_mm(job_.settings.top_of(total_ - 1)),
                                   report_.totals.external_support_volume_mm3 > 0};
            gcode_->write(gcode_header(job_.settings, job_.tracks, job_.printer, facts, thumbnails()));
            spool_->replay_backwards([&](std::string_view text) { gcode_->write(text); });
            gcode_->write(end_of_layers_);
            gcode_->write(gcode_footer(job_.settings, job_.printer, facts));
            gcode_->finish();
        }
        if (walls_) {
            if (as_3mf_)
                walls_->write(walls_3mf(kept_walls_));
            else
                walls_->overwrite(0, stl_header(facets_));
            walls_->finish();
        }
        shapes_.write(report_);
        times_["write"] = seconds_since(from);
        report_.machine.threads = static_cast<int>(thread_limit(job_.threads));
        report_.machine.stage_seconds = times_;
        report_.machine.seconds = seconds_since(start_);
        report_.machine.peak_memory_mb = peak_memory_mb();
        if (json_) {
            json_->write(to_json(report_));
            json_->finish();
        }
        end_if(job_.stop);
        if (gcode_) gcode_->commit();
        if (walls_) walls_->commit();
        if (folder_) folder_->commit(svgs_);
        shapes_.commit();
        if (json_) json_->commit();
    }

    Job job_;  ///< with what was chosen
    Time::time_point start_;
    Mesh mesh_;
    Chosen chosen_;
    RunReport report_;
    std::string kept_walls_, end_of_layers_;
    std::optional<PictureFolder> folder_;
    std::deque<std::shared_ptr<LayerOutput>> waiting_;  ///< from the top
    Box box_;
    std::optional<AtomicFile> gcode_, json_, walls_;
    std::optional<LayerSpool> spool_;
    ShapeOutputs shapes_;
    std::vector<AtomicFile> svgs_;
    bool as_3mf_ = false;
    std::uint32_t facets_ = 0;
    int total_ = 0;
    StageTimes times_;
    Clock joining_;
};

}  // namespace

RunReport generate(const Job& job) { return Run(job).execute(); }

}  // namespace ribvault
