#include "ribvault/report/svg_path.hpp"

#include <charconv>
#include <cmath>
#include <vector>

namespace ribvault {
namespace {

/// Micrometres on paper. Relative moves between rounded places do not add up errors.
struct Place {
    long long x, y;
};

Place place(Point p) {
    const auto rounded = [](Unit u) { return std::llround(static_cast<double>(u) * 1000 / units_per_mm); };
    return {rounded(p.x), -rounded(p.y)};
}

void append_micrometres(std::string& text, long long value) {
    if (value < 0) text += '-', value = -value;
    char digits[24];
    if (value >= 1000 || value == 0)
        text.append(digits, std::to_chars(digits, digits + sizeof digits, value / 1000).ptr);
    int fraction = static_cast<int>(value % 1000);
    if (fraction == 0) return;
    text += '.';
    for (int unit = 100; fraction > 0; unit /= 10) {
        text += static_cast<char>('0' + fraction / unit);
        fraction %= unit;
    }
}

void append_pair(std::string& text, char command, long long x, long long y) {
    if (command != ' ' || x >= 0) text += command;
    append_micrometres(text, x);
    if (y >= 0) text += ' ';
    append_micrometres(text, y);
}

/// A polyline; steps of less than a micrometre are left out.
class Pen {
public:
    explicit Pen(std::string& text) : text_(text) {}
    void move(Point p) {
        at_ = place(p);
        append_pair(text_, 'M', at_.x, at_.y);
        moved_ = true;
    }
    void line(Point p) {
        const Place to = place(p);
        if (to.x == at_.x && to.y == at_.y) return;
        append_pair(text_, moved_ ? 'l' : ' ', to.x - at_.x, to.y - at_.y);
        moved_ = false;
        at_ = to;
    }

    /// Nothing was drawn since the move.
    bool at_start() const { return moved_; }

private:
    std::string& text_;
    Place at_{0, 0};
    bool moved_ = true;
};

}  // namespace

std::string svg_number(double value) {
    std::string text;
    append_micrometres(text, std::llround(value * 1000));
    return text;
}

std::string region_data(const Region& region) {
    std::string data;
    Pen pen(data);
    for (const Contour& c : region) {
        if (c.size() < 3) continue;
        pen.move(c.front());
        for (std::size_t i = 1; i < c.size(); ++i) pen.line(c[i]);
        data += 'z';
    }
    return data;
}

void append_line(std::string& data, const std::vector<Point>& points) {
    if (points.empty()) return;
    Pen pen(data);
    pen.move(points.front());
    for (std::size_t i = 1; i < points.size(); ++i) pen.line(points[i]);
    if (pen.at_start()) data += "h0";
}

void append_dot(std::string& data, Point at) {
    Pen(data).move(at);
    data += "h0";
}

std::string track_data(const SupportForest& forest) {
    return track_data(forest, [](const SupportVertex&) { return true; });
}

std::string track_data(const SupportForest& forest, const std::function<bool(const SupportVertex&)>& drawn) {
    using Vertex = SupportForest::vertex_descriptor;
    std::string data;
    Pen pen(data);
    for (auto [v, end] = vertices(forest); v != end; ++v) {
        if (!drawn(forest[*v])) continue;
        if (out_degree(*v, forest) == 0) append_dot(data, forest[*v].at);
        if (out_degree(*v, forest) == 2) continue;
        for (auto [n, last] = adjacent_vertices(*v, forest); n != last; ++n) {
            std::vector<Vertex> chain{*v, *n};
            while (out_degree(chain.back(), forest) == 2) {
                auto next = adjacent_vertices(chain.back(), forest).first;
                chain.push_back(*next != chain[chain.size() - 2] ? *next : *++next);
            }
            if (chain.back() < *v) continue;  // drawn from its other end
            pen.move(forest[*v].at);
            for (std::size_t i = 1; i < chain.size(); ++i) pen.line(forest[chain[i]].at);
        }
    }
    return data;
}

}  // namespace ribvault
