// The parts of a run's report that its layers file has too.
#pragma once

#include <string>
#include <string_view>

#include "ribvault/report/run_report.hpp"

namespace ribvault {

/// The members "program" to "totals" of the report as JSON text, `separator` between them.
std::string run_members(const RunReport& report, std::string_view separator);

/// One layer of the report, a JSON object on one line.
std::string layer_json(const LayerReport& layer);

}  // namespace ribvault
