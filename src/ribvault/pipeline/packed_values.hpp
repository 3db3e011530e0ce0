// Values in a row of bytes, for what waits on disk until this process reads it again (pipeline/layer_spool.hpp).
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "ribvault/exact/lattice.hpp"

namespace ribvault {

template <class T>
void pack(std::string& to, const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::uint64_t n = values.size();
    to.append(reinterpret_cast<const char*>(&n), sizeof n);
    if (n > 0) to.append(reinterpret_cast<const char*>(values.data()), n * sizeof(T));  // else data() may be null
}
inline void pack(std::string& to, const Region& region) {
    const std::uint64_t n = region.size();
    to.append(reinterpret_cast<const char*>(&n), sizeof n);
    for (const Contour& contour : region) pack(to, contour);
}

/// Takes from the front what pack put there.
template <class T>
void unpack(std::string_view& from, std::vector<T>& values) {
    std::uint64_t n = 0;
    std::memcpy(&n, from.data(), sizeof n);
    values.resize(n);
    if (n > 0) std::memcpy(values.data(), from.data() + sizeof n, n * sizeof(T));
    from.remove_prefix(sizeof n + n * sizeof(T));
}
inline void unpack(std::string_view& from, Region& region) {
    std::uint64_t n = 0;
    std::memcpy(&n, from.data(), sizeof n);
    from.remove_prefix(sizeof n);
    region.resize(n);
    for (Contour& contour : region) unpack(from, contour);
}

}  // namespace ribvault
