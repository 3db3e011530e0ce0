#include "cli/printer_options.hpp"

#include "ribvault/error.hpp"
#include "ribvault/input_stream.hpp"
#include "ribvault/print/printer_profile.hpp"

namespace ribvault::cli {
namespace {

std::string text_of(const std::string& file) {
    std::string text = read_input(file, "text");
    if (text.find('\0') != std::string::npos) throw Error(ErrorKind::unreadable, file + ": is no text file");
    if (text.find_first_not_of(" \t\r\n") == std::string::npos)
        throw Error(ErrorKind::unreadable, file + ": is empty; it should hold settings, 'key = value'");
    return text;
}

Imported import(const std::string& file, Job& job) {
    Settings& s = job.settings;
    s.first_layer_height = s.support_width = 0;
    const ImportedConfig imported = import_prusaslicer(text_of(file), file, s, job.tracks, job.printer);
    std::string list;
    for (const std::string& key : imported.ignored) (list += list.empty() ? "" : ", ") += key;
    const std::string summary = file + ": " + std::to_string(imported.taken.size()) + " settings taken, " +
                                std::to_string(imported.ignored.size()) + " ignored" + (list.empty() ? "" : ": ") +
                                list;
    const auto named = [](Unit value) { return value > 0 ? std::optional(value) : std::nullopt; };
    return {file, summary, imported.doubts, named(s.first_layer_height), named(s.support_width)};
}

}  // namespace

void add_profiles(CLI::App* command, Job& job, Imported& imported) {
    std::string names;
    for (const BuiltinProfile& profile : builtin_profiles()) (names += names.empty() ? "" : ", ") += profile.name;
    const auto printer = command
                             ->add_option_function<std::string>(
                                 "--printer", [&job](const std::string& name) { job.printer = builtin_profile(name); },
                                 "a built-in profile: " + names)
                             ->type_name("NAME");
    const auto profile = command
                             ->add_option_function<std::string>(
                                 "--profile",
                                 [&job](const std::string& file) {
                                     job.printer = read_profile(text_of(file), file);
                                     job.settings_files.emplace_back(file);
                                 },
                                 "a printer profile (docs/printing.md)")
                             ->type_name("FILE")
                             ->excludes(printer);
    command
        ->add_option_function<std::string>(
            "--import",
            [&job, &imported](const std::string& file) {
                job.settings_files.emplace_back(file);
                imported = import(file, job);
            },
            "a PrusaSlicer config or bundle (.ini)")
        ->type_name("FILE")
        ->excludes(printer)
        ->excludes(profile);
}

void add_tracks(CLI::App* command, TrackSettings& t) {
    const auto group = command->add_option_group("Shell and covers");
    group->add_flag("--inner-first", t.inner_first, "perimeters from the inside out");
    group->add_flag_callback("--shell-first", [&t] { t.alternate = false; },
                             "perimeters first on every layer; by default last on odd ones, which saves travel");
    add_choice(group, "--covers", t.covers,
               {{"zigzag", CoverPattern::zigzag},
                {"monotonic", CoverPattern::monotonic},
                {"concentric", CoverPattern::concentric}},
               "pattern of solid layers (default zigzag)");
    add_choice(group, "--seam", t.seam,
               {{"aligned", Seam::aligned}, {"corner", Seam::corner}, {"nearest", Seam::nearest}},
               "where outer perimeters begin (default aligned)");
    group->add_flag_callback(
        "--no-thin-walls", [&t] { t.thin_walls = false; },
        "no tracks where the slice is narrower than one, two where it is a little wider");
    add_choice(group, "--fill-gaps", t.fill_gaps,
               {{"all", GapFill::all}, {"needed", GapFill::needed}, {"none", GapFill::none}},
               "which strips of the shell that are too narrow for covers get a track (default needed: what shows and "
               "what something stands on)");
    add_length(group, "--resolution", t.resolution,
               "tool paths follow slices within this (default 0.005; 0: every vertex)");
    group
        ->add_option_function<std::string>(
            "--first-layer-width",
            [&t](const std::string& text) {
                t.first_layer_width = parse_length(text, "--first-layer-width");
                if (t.first_layer_width == 0)
                    throw Error(ErrorKind::usage, "--first-layer-width is 0; leave it out for the nozzle's width");
            },
            "of perimeters and covers on layer 0 (default: the nozzle)")
        ->type_name("MM");
    add_whole(group, "--skirt", t.skirt_loops, "loops around the first layer (default 0)");
    add_length(group, "--skirt-distance", t.skirt_distance, "from the object to the skirt (default 3)");
    add_length(group, "--brim", t.brim_width, "width of the brim on the first layer (default 0)");
}

void add_printer(CLI::App* command, PrinterSettings& p) {
    const auto group = command->add_option_group("Printer");
    add_choice(
        group, "--flavour", p.flavour,
        {{"marlin", Flavour::marlin}, {"klipper", Flavour::klipper}, {"reprapfirmware", Flavour::reprapfirmware}},
        "whose G-code it is (default marlin)");
    const auto number = [&](const std::string& option, double& target, const std::string& help) {
        add_decimal(group, option, target, help)->default_str(CLI::detail::to_string(target));
    };
    const auto whole = [&](const std::string& option, int& target, const std::string& help) {
        add_whole(group, option, target, help)->default_str(CLI::detail::to_string(target));
    };
    // Whoever names one temperature means it from the first layer on.
    const auto temperature = [&](const std::string& option, int& target, int& first_layer, const std::string& help) {
        group
            ->add_option_function<std::string>(
                option,
                [&target, &first_layer, option](const std::string& text) {
                    target = whole_in(text, option);
                    first_layer = 0;
                },
                help)
            ->type_name("INT")
            ->default_str(CLI::detail::to_string(target));
    };
    number("--filament-diameter", p.filament_diameter, "mm");
    temperature("--temperature", p.nozzle_temperature, p.first_layer_temperature, "nozzle, degrees C");
    temperature("--bed-temperature", p.bed_temperature, p.first_layer_bed_temperature, "degrees C");
    whole("--first-layer-temperature", p.first_layer_temperature, "nozzle on layer 0; 0: as --temperature");
    whole("--first-layer-bed-temperature", p.first_layer_bed_temperature, "0: as --bed-temperature");
    whole("--support-extruder", p.support_extruder, "tool that prints external supports; T0 prints all else");
    whole("--support-temperature", p.support_temperature, "of that tool, degrees C; 0: as --temperature");
    number("--fan", p.fan_percent, "from the second layer on, percent");
    number("--print-speed", p.print_speed, "perimeters and covers, mm/s");
    number("--support-speed", p.support_speed, "supports, mm/s");
    number("--first-layer-speed", p.first_layer_speed, "mm/s");
    number("--min-layer-time", p.min_layer_time, "s; a layer that would take less is printed slower");
    number("--min-print-speed", p.min_print_speed, "mm/s; but not slower than this");
    number("--travel-speed", p.travel_speed, "mm/s");
    number("--retraction", p.retraction, "mm of filament");
    number("--retraction-speed", p.retraction_speed, "mm/s");
    number("--retract-over", p.retract_over, "mm of open air under a travel from which it retracts");
    number("--longest-detour", p.longest_detour, "mm that a travel may be longer to stay inside the shell");
    number("--prime-surplus", p.prime_surplus, "share of the retraction added before support paths");
    number("--surplus-clearance", p.surplus_clearance, "mm from a perimeter within which it is not");
    group->add_option("--thumbnails", p.thumbnails, "pictures in the G-code, WxH[,WxH]; none: no picture")
        ->capture_default_str();
}

}  // namespace ribvault::cli
