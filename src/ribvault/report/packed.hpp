// Numbers as few bytes as they need: how the run page carries its layers. src/page/unpack.js reads them.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ribvault/exact/lattice.hpp"

namespace ribvault {

/// Appends numbers to a text of bytes: seven bits a byte, lowest first, the top bit for "more"; the sign in the lowest
/// bit. Coordinates are rounded to 0.01 mm and relative to the point before.
class Packed {
public:
    void natural(std::uint64_t value) {
        for (; value >= 128; value >>= 7) bytes_ += static_cast<char>((value & 127) | 128);
        bytes_ += static_cast<char>(value);
    }
    void whole(std::int64_t value) {
        natural(value < 0 ? 2 * static_cast<std::uint64_t>(-(value + 1)) + 1 : 2 * static_cast<std::uint64_t>(value));
    }
    /// A text and its length.
    void text(std::string_view value) {
        natural(value.size());
        bytes_ += value;
    }
    void point(Point p) {
        const auto hundredths = [](Unit u) {
            return static_cast<std::int64_t>(std::llround(static_cast<double>(u) * 100 / units_per_mm));
        };
        const std::int64_t x = hundredths(p.x), y = hundredths(p.y);
        whole(x - x_), whole(y - y_);
        x_ = x, y_ = y;
    }
    void points(const std::vector<Point>& all) {
        natural(all.size());
        for (Point p : all) point(p);
    }
    void region(const Region& region) {
        natural(region.size());
        for (const Contour& contour : region) points(contour);
    }
    const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
    std::int64_t x_ = 0, y_ = 0;
};

}  // namespace ribvault
