#include "ribvault/pipeline/verify_print.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <set>

#include "ribvault/error.hpp"
#include "ribvault/lower_case.hpp"
#include "ribvault/output_file.hpp"
#include "ribvault/pipeline/check_outputs.hpp"
#include "ribvault/pipeline/clock.hpp"
#include "ribvault/pipeline/judge_layer.hpp"
#include "ribvault/pipeline/picture_folder.hpp"
#include "ribvault/pipeline/thread_limit.hpp"
#include "ribvault/print/printed_layers.hpp"
#include "ribvault/print/read_gcode.hpp"
#include "ribvault/report/number_text.hpp"
#include "ribvault/report/print_page.hpp"
#include "ribvault/report/printed_layer_svg.hpp"
#include "ribvault/report/run_report.hpp"

namespace ribvault {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw Error(ErrorKind::usage, what); }

/// Per feature of the print: whether it has tracks.
std::vector<char> printed_features(const GcodePrint& print) {
    std::vector<char> printed(print.features.size(), 0);
    for (const GcodeLayer& layer : print.layers)
        for (const GcodeTrack& t : layer.tracks) printed[t.feature] = 1;
    return printed;
}

/// Per feature of the print: whether the list names it or its kind. An entry that names none that is printed is
/// refused.
std::vector<char> named(const GcodePrint& print, const std::vector<std::string>& list, const char* option) {
    std::vector<char> chosen(print.features.size(), 0);
    const std::vector<char> printed = printed_features(print);
    for (const std::string& entry : list) {
        bool any = false;
        for (std::size_t k = 0; k < print.features.size(); ++k) {
            if (!printed[k]) continue;
            if (lower_case(entry) != lower_case(print.features[k].name) &&
                lower_case(entry) != kind_name(print.features[k].kind))
                continue;
            chosen[k] = 1;
            any = true;
        }
        if (any) continue;
        std::set<std::string> known;
        for (std::size_t k = 0; k < print.features.size(); ++k)
            if (printed[k]) known.insert(print.features[k].name);
        std::string names;
        for (const std::string& name : known) names += (names.empty() ? "'" : ", '") + name + "'";
        refuse(std::string(option) + ": the print has no '" + entry + "'; it has " + names +
               " (kinds: perimeter, infill, solid, bridge, support, skirt, tower, other)");
    }
    return chosen;
}

void check(const VerifyJob& job) {
    const auto need = [](const std::optional<Rational>& value, const char* option, const Rational& most) {
        if (value && (*value <= 0 || *value > most))
            refuse(std::string(option) + " is " + value->get_str() + "; it must be more than 0 and at most " +
                   most.get_str());
    };
    need(job.support_radius, "--support-radius", 100);
    need(job.nozzle, "--nozzle", 100);
    need(job.filament_diameter, "--filament-diameter", 100);
    need(job.layer_height, "--layer-height", 100);
    if (job.layer_height && *job.layer_height < Rational(1, 1000))
        refuse("--layer-height is " + job.layer_height->get_str() + "; it must be at least 0.001");
    need(job.longest_bridge, "--allow-bridges", 10000);
    if (job.overlap && (*job.overlap < 0 || *job.overlap >= 1))
        refuse("--overlap is " + job.overlap->get_str() + "; it must be at least 0 and less than 1");
    if (job.min_area < 0) refuse("--min-area is " + job.min_area.get_str() + "; it must be 0 or more");
    if (job.infill_layers < 1 || job.infill_layers > 100)
        refuse("--infill-layers is " + std::to_string(job.infill_layers) + "; it must be from 1 to 100");
    if (job.threads < 0) refuse("--threads must be 0 (all processors) or more");
}

class Run {
public:
    explicit Run(const VerifyJob& job) : job_(job), start_(Time::now()) {}

    JudgedPrint execute() {
        check(job_);
        open_outputs();
        read();
        settle();
        choose_features();
        judge();
        sum_up(report_);
        report_.seconds = seconds_since(start_);
        report_.peak_memory_mb = peak_memory_mb();
        write_outputs();
        return {std::move(print_), std::move(report_)};
    }

private:
    void open_outputs() {
        check_outputs({job_.gcode}, {{"--report", job_.report}, {"--html", job_.html}}, job_.svg);
        if (job_.report) json_.emplace(*job_.report);
        if (job_.html) page_.emplace(*job_.html);
        if (job_.svg) folder_.emplace(*job_.svg);
    }

    void read() {
        GcodeOptions options;
        if (job_.filament_diameter) options.filament_diameter = job_.filament_diameter->get_d();
        if (job_.nozzle) options.nozzle = job_.nozzle->get_d();
        if (job_.layer_height) options.layer_height = job_.layer_height->get_d();
        options.infill_layers = job_.infill_layers;
        print_ = read_gcode(job_.gcode, options);
        report_.version = RIBVAULT_VERSION;
        report_.input_path = job_.gcode.string();
        report_.flavour = flavour_name(print_.flavour);
        report_.program = print_.program;
        report_.cut = print_.cut;
        report_.lines = print_.lines;
        report_.bytes = print_.bytes;
        report_.set_aside_mm = print_.set_aside_mm;
        report_.widths_written = print_.widths_written;
        report_.widths_computed = print_.widths_computed;
        report_.layer_count = print_.layer_count;
        report_.filament_mm = print_.filament_diameter;
        report_.infill_layers = job_.infill_layers;
        if (job_.layer_height) report_.layer_height_mm = job_.layer_height->get_d();
        report_.filament_source = job_.filament_diameter ? "option" : print_.filaments.empty() ? "default" : "file";
        report_.read_seconds = seconds_since(start_);
        if (!print_.cut.empty()) job_.warn(report_.input_path + " is cut off: " + print_.cut + "; judged up to there");
        if (!print_.layers.empty()) {
            const double top = to_double(print_.layers.front().z),
                         height = 1e-9 * static_cast<double>(print_.layers.front().height);
            if (top > 2 * height)
                job_.warn("the lowest layer begins " + std::to_string(top - height) +
                          " mm over z = 0; it counts as lying on the bed all the same");
        }
        if (print_.interleaved_layers > 2)
            job_.warn(
                "the file does not say how high layers are, and " + std::to_string(print_.interleaved_layers) +
                " lie beside the next lower one and over others, as where objects or supports have layers of their "
                "own; then it cannot be judged rightly: export it with ;HEIGHT: comments");
        if (print_.layers_over_air > 0)
            job_.warn(
                std::to_string(print_.layers_over_air) +
                " of the layers lie farther over the next lower one than a layer can be high: there is air below");
        if (const auto& [feature, apart] = print_.sparse_infill; apart > 1)
            job_.warn("layers with '" + feature + "' are " + std::to_string(apart) +
                      " apart, and the file does not say how high it is; if it is so many layers thick, "
                      "--infill-layers " +
                      std::to_string(apart) + " says so");
        if (const auto& [tracks, line, widest] = print_.too_wide; tracks > 0)
            job_.warn("on " + many(static_cast<long long>(tracks), "track") + " (the first is on line " +
                      std::to_string(line) + ") more is pushed than a nozzle lays; each counts as " +
                      fixed(1e-9 * static_cast<double>(widest), 2) +
                      " mm wide, three nozzles, for what lies on it: --nozzle and --filament-diameter say others");
        if (print_.widths_computed > 0 && report_.filament_source == "default")
            job_.warn(
                "widths are computed from E with filament of 1.75 mm, as the file names none; --filament-diameter says "
                "another");
    }

    /// ρ and what it comes from.
    void settle() {
        Rational nozzle(2, 5);
        report_.nozzle_source = "default";
        if (job_.nozzle) {
            nozzle = *job_.nozzle;
            report_.nozzle_source = "option";
        } else if (!print_.nozzles.empty()) {
            nozzle = to_rational(*std::min_element(print_.nozzles.begin(), print_.nozzles.end()));
            report_.nozzle_source = "file";
        }
        const Rational overlap = job_.overlap.value_or(Rational(1, 2));
        radius_ = job_.support_radius.value_or((1 - overlap) * nozzle);
        report_.support_radius_source = job_.support_radius ? "--support-radius"
                                        : job_.overlap      ? "--overlap"
                                                            : "half the nozzle";
        report_.nozzle_mm = nozzle.get_d();
        report_.support_radius_mm = radius_.get_d();
        report_.support_radius_exact = radius_.get_str();
        if (job_.longest_bridge) report_.longest_bridge_mm = job_.longest_bridge->get_d();
        report_.boundaries = job_.boundaries;
        report_.min_area_mm2 = job_.min_area.get_d();
        report_.inside = job_.inside;
        const Rational gap = job_.support_gap.value_or(0);
        if (gap < 0) refuse("--support-gap must be 0 or more");
        report_.support_gap_mm = gap.get_d();
        // Supports that stand off keep their edge off the object's.
        if (job_.support_gap || job_.support_gap_layers > 0 || job_.bed_only)
            object_reach_ = std::max<Rational>(0, gap + nozzle / 2 - radius_);
        if (job_.support_gap_layers < 0 || job_.support_gap_layers > 100)
            refuse("--support-gap-layers must lie between 0 and 100");
        report_.support_gap_layers = job_.support_gap_layers;
        report_.bed_only = job_.bed_only;
        if (job_.bed_only && job_.longest_bridge)
            refuse("--bed-only and --allow-bridges: bridges are judged over the object too; give one of them");
        if (job_.bed_only && job_.inside) refuse("--bed-only is about what --inside leaves out; give one of them");
        if (job_.inside || object_reach_ != 0 || job_.support_gap_layers > 0) look_for_outlines();
    }

    /// What lies over a layer is outside where no loop bounds it.
    void look_for_outlines() {
        std::vector<OutlineState> states(static_cast<std::size_t>(print_.layer_count));
        for (const GcodeLayer& layer : print_.layers)  // entries of one layer have one outline
            states[static_cast<std::size_t>(layer.layer)] += outline_state(print_.features, layer);
        for (int k = 0; k + 1 < print_.layer_count; ++k)
            if (!states[static_cast<std::size_t>(k)].whole()) report_.layers_without_outline.push_back(k);
        if (job_.inside && std::none_of(states.begin(), states.end(), [](const OutlineState& s) { return s.loops; }))
            refuse("--inside needs closed loops of outer perimeter, and " + job_.gcode.string() +
                   " has none that end exactly where they begin; judge it without");
        if (const std::vector<int>& without = report_.layers_without_outline; !without.empty())
            job_.warn("on " + many(static_cast<long long>(without.size()), "layer") + " (the lowest is layer " +
                      std::to_string(without.front()) +
                      ") there is no outer perimeter, or some of it does not end where it begins and bounds nothing: "
                      "what lies over that counts as outside" +
                      (job_.inside ? " and is not judged" : ""));
    }

    void choose_features() {
        judged_.assign(print_.features.size(), 1);
        if (!job_.features.empty()) judged_ = named(print_, job_.features, "--features");
        const std::vector<char> ignored = named(print_, job_.ignored_features, "--ignore-features");
        for (std::size_t k = 0; k < judged_.size(); ++k) judged_[k] = judged_[k] != 0 && ignored[k] == 0 ? 1 : 0;
        const std::vector<char> printed = printed_features(print_);
        bool any = false;
        for (std::size_t k = 0; k < judged_.size(); ++k) any = any || (judged_[k] != 0 && printed[k] != 0);
        if (!any) refuse("--features and --ignore-features leave nothing to judge");
    }

    void judge() {
        namespace tbb = oneapi::tbb;
        const std::size_t limit = thread_limit(job_.threads);
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, limit);
        report_.threads = static_cast<int>(limit);
        const LayerRules rules{.support_radius = radius_,
                               .longest_bridge = job_.longest_bridge,
                               .min_area = job_.min_area.get_d(),
                               .judged = judged_,
                               .inside = job_.inside,
                               .object_reach = object_reach_,
                               .gap_layers = job_.support_gap_layers,
                               .supports_alone = job_.bed_only,
                               .distances = job_.distances};
        const int total = static_cast<int>(print_.layers.size());
        std::vector<JudgedLayer> judged(print_.layers.size());
        std::mutex reporting;
        int done = 0;
        tbb::parallel_for(std::size_t{0}, print_.layers.size(), [&](std::size_t k) {
            if (job_.stop()) return;
            judged[k] = judge_layer(print_, k, rules);
            const std::lock_guard lock(reporting);
            job_.progress(++done, total);
        });
        end_if(job_.stop);
        for (std::size_t k = 0; k < print_.features.size(); ++k) {
            HangingFeature f;
            f.name = print_.features[k].name;
            f.kind = kind_name(print_.features[k].kind);
            f.judged = judged_[k] != 0;
            report_.features.push_back(std::move(f));
        }
        for (JudgedLayer& layer : judged) {
            for (std::size_t k = 0; k < layer.features.size(); ++k) {
                HangingFeature& f = report_.features[k];
                const FeatureShare& share = layer.features[k];
                f.tracks += share.tracks;
                f.length_mm += share.length_mm;
                f.unsupported_mm += share.unsupported_mm;
                f.bridged_mm += share.bridged_mm;
            }
            report_.layers.push_back(std::move(layer.layer));
        }
    }

    void write_outputs() {
        std::vector<AtomicFile> pictures;
        if (job_.svg) {
            for (const std::size_t k : worst_layers(report_, static_cast<std::size_t>(std::max(0, job_.pictures)))) {
                const HangingLayer& layer = report_.layers[k];
                const bool parts = (k > 0 && report_.layers[k - 1].layer == layer.layer) ||
                                   (k + 1 < report_.layers.size() && report_.layers[k + 1].layer == layer.layer);
                const std::string part = std::to_string(std::lround(layer.height_mm * 1000)) + "um";
                pictures.push_back(folder_->picture(layer.layer, parts ? part : ""));
                pictures.back().write(printed_layer_svg(print_, report_, k));
            }
        }
        if (page_) {
            RunPage page([this](std::string_view text) { page_->write(text); });
            append_print(page, print_, report_);
            page.finish();
        }
        if (json_) json_->write(to_json(report_));
        if (page_) page_->finish();
        if (json_) json_->finish();
        for (AtomicFile& picture : pictures) picture.finish();
        end_if(job_.stop);
        if (folder_) folder_->commit(pictures);
        if (page_) page_->commit();
        if (json_) json_->commit();
    }

    const VerifyJob& job_;
    const Time::time_point start_;
    std::optional<PictureFolder> folder_;
    GcodePrint print_;
    PrintReport report_;
    Rational radius_, object_reach_ = 0;
    std::vector<char> judged_;  ///< per feature
    std::optional<AtomicFile> json_, page_;
};

}  // namespace

PrintReport verify_print(const VerifyJob& job) { return Run(job).execute().report; }

JudgedPrint judged_print(const VerifyJob& job) { return Run(job).execute(); }

}  // namespace ribvault
