#include "ribvault/report/layers_file.hpp"

#include "ribvault/report/report_members.hpp"

namespace ribvault {

std::string layers_header(const RunReport& report) {
    return std::string("{\"schema\":\"") + layers_schema + "\"," + run_members(report, ",") + "}";
}

std::string layers_line(const LayerReport& layer, const std::string& shapes) {
    std::string line = layer_json(layer);
    line.back() = ',';
    return line + shapes + "}";
}

std::string page_facts(const std::string& header) { return "{\"kind\":\"layers\",\"run\":" + header + "}"; }

}  // namespace ribvault
