// Settings from PrusaSlicer: an exported config or a config bundle (.ini).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ribvault/print/track_settings.hpp"
#include "ribvault/settings.hpp"

namespace ribvault {

/// A value that cannot be: what the check of all settings says of it, and its file, line and key.
struct ImportDoubt {
    std::string message, where;
};

/// What became of the entries of a config.
struct ImportedConfig {
    std::vector<std::string> taken;    ///< keys
    std::vector<std::string> ignored;  ///< keys, with the reason in brackets where the key is known but not this value
    std::vector<ImportDoubt> doubts;   ///< of values taken
};

/// Takes the fields we know from a config; all others are named in the result. Exact lengths stay exact.
///
/// A config without sections, as "Export Config" writes it, is taken whole. Of a bundle the presets that its [presets]
/// section names, otherwise the last of each kind ([print:...], [filament:...], [printer:...]) whose name has no stars;
/// what they inherit from other presets of the bundle comes first. Start and end G-code are taken with the placeholders
/// that we know translated; with others or with expressions they are ignored. Throws Error (usage) with name, line and
/// key when a value that we know is no number, or when nothing is known. Values that cannot be are taken all the same
/// and named in `doubts`: options may still replace them.
ImportedConfig import_prusaslicer(std::string_view text, const std::string& name, Settings& settings,
                                  TrackSettings& tracks, PrinterSettings& printer);

}  // namespace ribvault
