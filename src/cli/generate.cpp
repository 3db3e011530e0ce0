#include <algorithm>
#include <charconv>
#include <cstdio>
#include <optional>

#include "cli/commands.hpp"
#include "cli/interrupt.hpp"
#include "cli/printer_options.hpp"
#include "cli/progress.hpp"
#include "ribvault/error.hpp"
#include "ribvault/pipeline/generate.hpp"
#include "ribvault/print/ini.hpp"

namespace ribvault::cli {
namespace {

/// What the user wrote, before defaults that depend on other settings are known.
struct Written {
    Job job;
    std::string model, gcode, report, svg, mesh, layers, html;
    std::optional<Unit> first_layer_height, support_width, support_radius, erosion_step, straighten_step, branch_bonus,
        pitch, pillar_length, leaning_length;
    std::optional<Rational> overlap;
    std::string strategy = "paper", quarter_bonus;
    bool no_shrink = false, no_trim = false, no_doubling = false;
    bool leaning_ratio = false;  ///< given
    bool no_straighten = false, no_branch_bonus = false, quiet = false;
    std::string rotate, up = "z";
    Imported imported;
};

std::uint64_t parse_seed(const std::string& text) {
    std::uint64_t seed = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
    if (error != std::errc() || end != text.data() + text.size())
        throw Error(ErrorKind::usage, "--seed: '" + text + "' is no whole number from 0 to 18446744073709551615");
    return seed;
}

void choose_strategy(const Written& w, Settings& s) {
    const bool thrifty = w.strategy == "thrifty";
    const auto needs_thrifty = [&](bool given, const char* option) {
        if (given && !thrifty)
            throw Error(ErrorKind::usage,
                        std::string(option) + " takes something out of --strategy thrifty; give both");
    };
    needs_thrifty(w.no_shrink, "--no-shrink");
    needs_thrifty(w.no_trim, "--no-trim");
    needs_thrifty(w.no_doubling, "--no-doubling");
    const bool shrink = thrifty && !w.no_shrink;
    const auto needs_leaning = [&](bool given, const char* option) {
        if (given && !shrink)
            throw Error(ErrorKind::usage,
                        std::string(option) + ": trees lean with --strategy thrifty only, not with --no-shrink");
        if (given && !s.inside())
            throw Error(ErrorKind::usage,
                        std::string(option) + ": trees lean in cavities, and --support external lets none stand there");
    };
    needs_leaning(w.leaning_length.has_value(), "--leaning-length");
    needs_leaning(w.leaning_ratio, "--leaning-ratio");
    if (shrink && (w.no_straighten || w.straighten_step))
        throw Error(ErrorKind::usage, std::string(w.no_straighten ? "--no-straighten" : "--straighten-step") +
                                          ": --strategy thrifty does not straighten; give --no-shrink as well");
    s.propagation = shrink ? Propagation::shrink : Propagation::erode_straighten;
    s.order = thrifty && !w.no_doubling ? Order::doubling : Order::distance;
    s.trim = thrifty && !w.no_trim;
    const std::string places = !w.quarter_bonus.empty()        ? w.quarter_bonus
                               : thrifty && !w.no_branch_bonus ? "chosen"
                                                               : "nowhere";
    s.choose_bonus = places == "chosen";
    s.quarter_bonus = places == "nowhere"      ? QuarterBonus::nowhere
                      : places == "everywhere" ? QuarterBonus::everywhere
                                               : QuarterBonus::narrow;
}

void add_geometry(CLI::App* command, Written& w) {
    Settings& s = w.job.settings;
    command->get_formatter()->column_width(38);
    const std::string geometry = "Geometry";
    const auto group = command->add_option_group(geometry);
    add_length(group, "--layer-height", s.layer_height, "h (default 0.2)");
    add_length(group, "--first-layer-height", w.first_layer_height, "height of layer 0 (default: --layer-height)");
    add_length(group, "--nozzle", s.nozzle, "d, the width of tracks (default 0.4)");
    add_whole(group, "--perimeters", s.perimeters, "p (default 1)");
    add_whole(group, "--top-layers", s.top_layers, "solid layers under every roof (default 1)");
    add_whole(group, "--bottom-layers", s.bottom_layers, "solid layers over every floor (default 1)");
    add_length(group, "--max-gap", s.max_gap, "close open contours over gaps up to this (default 0.05)");
    const auto outside = command->add_option_group("External supports (Section 6)");
    add_choice(
        outside, "--support", s.support,
        {{"internal", Support::internal}, {"external", Support::external}, {"both", Support::both}},
        "internal: hollow, supports in the cavities; external: solid, supports outside; both (default internal)");
    add_length(outside, "--support-gap", s.support_gap,
               "keep external supports this far off the object, in plane (default 0)");
    add_whole(outside, "--support-gap-layers", s.support_gap_layers,
              "leave so many layers empty between them and what they hold up (default 0)");
    outside->add_flag("--bed-only", s.bed_only, "external supports stand on the bed, nowhere on the object");
    add_length(outside, "--pillar-length", w.pillar_length,
               "track on every layer of a tree that stands free and does not lean (default: ten times the nozzle)");
    const auto supports = command->add_option_group("Supports (Sections 4.1 to 4.3)");
    const auto radius = supports->add_option_function<std::string>(
        "--support-radius", [&w](const std::string& t) { w.support_radius = parse_length(t, "--support-radius"); },
        "rho of equation (2) (default: half the nozzle)")->type_name("MM");
    supports
        ->add_option_function<std::string>(
            "--overlap", [&w](const std::string& t) { w.overlap = parse_rational(t, "--overlap"); },
            "share of a track that must rest on the layer below; rho = (1 - R) d (default 0.5)")
        ->type_name("R")
        ->excludes(radius);
    add_length(supports, "--support-width", w.support_width, "width of the supports' tracks (default: the nozzle)");
    supports
        ->add_option("--strategy", w.strategy,
                     "paper: Sections 4.1 to 4.3; thrifty: less material under the same proof (default paper)")
        ->check(CLI::IsMember({"paper", "thrifty"}))
        ->type_name("NAME");
    add_choice(supports, "--gaps", s.gaps,
               {{"proved", Gaps::proved}, {"paper", Gaps::paper}, {"none", Gaps::none}},
               "at junctions (Section 4.4): proved: where the print is supported with them; paper: all; none (default "
               "proved)");
    supports->add_flag("--no-shrink", w.no_shrink, "thrifty without its descent of length");
    supports->add_flag("--no-trim", w.no_trim, "thrifty without trimming new walls");
    add_whole(supports, "--tries", s.tries, "seeds to try; the one that takes the least is used (default 1)");
    supports->add_flag("--no-doubling", w.no_doubling, "thrifty with the paper's order of points");
    supports->add_flag("--length-bound", s.length_bound, "report how short any supports could be at least");
    add_length(supports, "--erosion-step", w.erosion_step, "what a free tip loses per layer (default: rho)");
    supports->add_flag("--no-straighten", w.no_straighten, "leave out the straightening operator");
    const auto lines =
        add_whole(supports, "--wall-lines", s.wall_lines, "tracks side by side in long or tall walls (default 1)");
    add_length(supports, "--wall-lines-longer", s.wall_lines_longer,
               "what is long, from the root to the farthest tip (default 10)")
        ->needs(lines);
    add_length(supports, "--wall-lines-taller", s.wall_lines_taller, "what is tall (default 10)")->needs(lines);
    const auto pillars =
        supports->add_flag("--pillars", s.pillars,
                           "trees stand free where that takes less track down to the bed (Section 5.4); thrifty: in "
                           "cavities they lean towards the shell");
    add_length(supports, "--leaning-length", w.leaning_length,
               "track to which such a tree shrinks (with --strategy thrifty; default: five halves of the nozzle)")
        ->needs(pillars);
    add_whole(supports, "--leaning-ratio", s.leaning_ratio,
              "or to its height over this, where that is more (default 10)")
        ->needs(pillars)
        ->each([&w](const std::string&) { w.leaning_ratio = true; });
    add_length(supports, "--brace", s.brace, "trees that reach farther than this get a second root (default: none do)");
    add_length(supports, "--straighten-step", w.straighten_step, "how far a vertex moves per layer (default: rho)");
    const auto no_bonus =
        supports->add_flag("--no-branch-bonus", w.no_branch_bonus, "leave out the heuristic of equation (4)");
    add_length(supports, "--branch-bonus", w.branch_bonus, "its bonus (default: twice the nozzle, 4r)")
        ->excludes(no_bonus);
    supports
        ->add_option("--quarter-bonus", w.quarter_bonus,
                     "where that bonus counts a quarter: nowhere, narrow (places), everywhere, or chosen: what takes "
                     "least (default nowhere, thrifty: chosen)")
        ->excludes(no_bonus)
        ->check(CLI::IsMember({"nowhere", "narrow", "everywhere", "chosen"}))
        ->type_name("NAME");
    add_whole(supports, "--valence-limit", s.valence_limit, "valence from which a junction has no bonus (default 4)");
    supports
        ->add_option_function<std::string>(
            "--seed", [&s](const std::string& text) { s.seed = parse_seed(text); }, "of the ties (default 1)")
        ->type_name("UINT");
    add_length(supports, "--pitch", w.pitch, "spacing of the points to support (default: a quarter of the nozzle)");
    add_length(supports, "--slack", s.slack, "what the generator keeps clear of the limit (default 0.001)");
}

std::vector<double> numbers_of(const std::string& option, const std::string& text, std::size_t count,
                               const std::string& example) {
    try {
        return numbers_in(text, count, example);
    } catch (const Error& error) {
        throw Error(error.kind(), option + ": " + error.what());
    }
}

void add_placement(CLI::App* command, Written& w) {
    const auto group = command->add_option_group("Placement");
    const auto scale = group->add_option_function<std::string>(
        "--scale", [&w](const std::string& t) { w.job.placement.scale = parse_rational(t, "--scale"); },
        "multiply the model's size (0.5 or 1/2.4)")->type_name("S");
    group->add_option_function<std::string>(
        "--height", [&w](const std::string& t) { w.job.placement.height_mm = parse_rational(t, "--height"); },
        "scale the model to this height")->type_name("MM")->excludes(scale);
    group->add_option("--rotate", w.rotate, "turn about the axes, in degrees (multiples of 90 are exact)")
        ->type_name("X,Y,Z");
    group->add_option("--up", w.up, "the model's axis that points up")->check(CLI::IsMember({"x", "y", "z"}));
    group->add_option_function<std::string>("--bed", [&w](const std::string& text) {
        PrinterSettings& p = w.job.printer;
        const std::vector<double> size = numbers_of("--bed", text, 3, "--bed 250,210,200");
        p.bed_x = size[0], p.bed_y = size[1], p.bed_z = size[2];
    }, "size of the printer (default: the profile's; without one 250,250,250)")->type_name("X,Y,Z");
    group
        ->add_option_function<std::string>(
            "--bed-corner",
            [&w](const std::string& text) {
                const std::vector<double> corner = numbers_of("--bed-corner", text, 2, "--bed-corner 3,-5");
                w.job.printer.bed_corner = {corner[0], corner[1]}, w.job.printer.origin_at_centre = false;
            },
            "where the bed's front left corner is (default: the profile's; without one 0,0)")
        ->type_name("X,Y");
}

void set_rotation(Written& w) {
    if (w.rotate.empty()) return;
    std::vector<std::string> parts;
    for (std::size_t from = 0; from <= w.rotate.size();) {
        const std::size_t comma = std::min(w.rotate.find(',', from), w.rotate.size());
        parts.push_back(w.rotate.substr(from, comma - from));
        from = comma + 1;
    }
    if (parts.size() != 3)
        throw Error(ErrorKind::usage,
                    "--rotate: '" + w.rotate + "' is not three angles; write for example --rotate 90,0,0");
    for (std::size_t k = 0; k < 3; ++k) w.job.placement.rotate_degrees[k] = parse_rational(parts[k], "--rotate");
}

/// Options that were given in vain.
void refuse_without_effect(const Written& w, const CLI::App& command) {
    const struct {
        const char* option;
        bool has_effect;
        const char* without;
    } pairs[] = {{"--skirt-distance", w.job.tracks.skirt_loops > 0, "a skirt (--skirt N)"},
                 {"--support-extruder", w.job.settings.outside(), "external supports (--support external or both)"},
                 {"--support-temperature", w.job.settings.outside(), "external supports (--support external or both)"}};
    for (const auto& [option, has_effect, without] : pairs)
        if (!has_effect && command.get_option(option)->count() > 0)
            throw Error(ErrorKind::usage, std::string(option) + " has no effect without " + without);
}

/// Defaults that depend on other settings.
void complete(Written& w) {
    Settings& s = w.job.settings;
    choose_strategy(w, s);
    s.first_layer_height = w.first_layer_height.value_or(w.imported.first_layer_height.value_or(s.layer_height));
    s.support_width = w.support_width.value_or(w.imported.support_width.value_or(s.nozzle));
    s.support_radius = w.support_radius.value_or(s.nozzle / 2);
    if (w.overlap) {
        if (*w.overlap < 0 || *w.overlap >= 1)
            throw Error(ErrorKind::usage, "--overlap must be a share of a track's width, from 0 to less than 1");
        const Rational radius = (1 - *w.overlap) * s.nozzle;
        if (radius.get_den() != 1)
            throw Error(ErrorKind::usage,
                        "--overlap: (1 - R) times the nozzle does not lie on the 10 nm lattice; use fewer decimals");
        s.support_radius = radius.get_num().get_si();
        if (s.support_radius < units_per_mm / 100)
            throw Error(ErrorKind::usage, "--overlap leaves rho = " + millimetres(s.support_radius) +
                                              " mm; at least 0.01 mm must be left of (1 - R) times the nozzle");
    }
    s.erosion_step = w.erosion_step.value_or(s.support_radius);
    s.straighten_step = w.straighten_step.value_or(s.support_radius);
    s.branch_bonus_length = w.branch_bonus.value_or(2 * s.nozzle);
    s.pillar_length = w.pillar_length.value_or(10 * s.nozzle);
    s.leaning_length = w.leaning_length.value_or(5 * s.nozzle / 2);
    s.sampling_pitch = w.pitch.value_or(s.nozzle / 4);
    s.straighten = !w.no_straighten;
    s.branch_bonus = !w.no_branch_bonus;
    set_rotation(w);
    w.job.placement.up = w.up[0];
    w.job.placement.bed_x = w.job.printer.bed_x;
    w.job.placement.bed_y = w.job.printer.bed_y;
    w.job.placement.bed_z = w.job.printer.bed_z;
    w.job.placement.round_bed = w.job.printer.round_bed;
    w.job.placement.bed_corner = w.job.printer.corner_of_bed();
    w.job.model = w.model;
    const auto path = [](const std::string& text) {
        return text.empty() ? std::nullopt : std::optional<std::filesystem::path>(text);
    };
    w.job.gcode = path(w.gcode), w.job.report = path(w.report), w.job.svg = path(w.svg), w.job.mesh = path(w.mesh);
    w.job.layers = path(w.layers), w.job.html = path(w.html);
}

int run(Written& w, const CLI::App& command) {
    refuse_without_effect(w, command);
    complete(w);
    if (!w.quiet && !w.imported.file.empty()) std::fprintf(stderr, "%s\n", w.imported.summary.c_str());
    Progress progress(w.quiet);
    w.job.progress = [&](int done, int total) { progress(done, total); };
    w.job.stop = interrupted;
    w.job.warn = [&](const std::string& text) {
        if (!w.quiet) std::fprintf(stderr, "warning: %s\n", text.c_str());
    };
    Progress choosing(w.quiet, ", choosing");
    w.job.choosing = [&](int done, int total) {
        choosing(done, total);
        if (done == total) choosing.clear();
    };
    const RunReport report = [&] {
        try {
            return generate(w.job);
        } catch (const Error& error) {
            // The message may name an option that nobody gave.
            if (error.kind() != ErrorKind::usage || w.imported.file.empty()) throw;
            const std::string message = error.what();
            const auto doubt = std::find_if(w.imported.doubts.begin(), w.imported.doubts.end(),
                                            [&](const ImportDoubt& d) { return d.message == message; });
            throw Error(error.kind(), (doubt != w.imported.doubts.end() ? doubt->where + ": " : std::string()) +
                                          message + " (settings were imported from " + w.imported.file + ")");
        }
    }();
    progress.clear();
    // The paper's gaps are the user's choice; the report says what hangs because of them.
    const bool proved = report.verdict.proved && (report.verdict.print_proved || w.job.settings.gaps == Gaps::paper);
    if (!w.quiet) std::fputs(summary(report, w.job).c_str(), stdout);
    if (w.quiet && !proved) std::fputs(verdict_text(report, w.job).c_str(), stderr);
    return proved ? 0 : 1;
}

}  // namespace

std::function<int()> add_generate(CLI::App& app) {
    const auto written = std::make_shared<Written>();
    CLI::App* command =
        app.add_subcommand("generate", "Hollow a mesh, grow ribbed supports, prove every layer, write G-code");
    command->add_option("model", written->model, "STL, OBJ, OFF, PLY or 3MF")->required();
    add_output(command, "-o,--output", written->gcode, "G-code to write");
    add_output(command, "--report", written->report, "JSON report to write");
    add_output(command, "--svg", written->svg, "folder for one picture a layer", "DIR");
    add_output(command, "--mesh", written->mesh, "supports as solids, .stl or .3mf");
    add_output(command, "--layers", written->layers, "the geometry of every layer, as JSON lines");
    add_output(command, "--html", written->html, "page to look at the whole run, in one file");
    add_whole(command, "--threads", written->job.threads, "0: all processors", 0, 1024);
    command->add_flag("--quiet", written->quiet, "print errors only");
    add_profiles(command, written->job, written->imported);
    add_geometry(command, *written);
    add_tracks(command, written->job.tracks);
    add_placement(command, *written);
    add_printer(command, written->job.printer);
    return [written, command] { return run(*written, *command); };
}

}  // namespace ribvault::cli
