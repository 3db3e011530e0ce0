#include "ribvault/print/thumbnail.hpp"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>

#include "ribvault/error.hpp"

namespace ribvault {
namespace {

/// Where a corner is seen: right, down, and how near.
Corner seen(const Corner& c) {
    const double turn = 0.6, tilt = 0.5;  // rad, about z, then about the horizontal
    const double right = c[0] * std::cos(turn) + c[1] * std::sin(turn),
                 away = -c[0] * std::sin(turn) + c[1] * std::cos(turn);
    return {right, -(c[2] * std::cos(tilt) + away * std::sin(tilt)), c[2] * std::sin(tilt) - away * std::cos(tilt)};
}

struct Picture {
    int width, height;
    std::vector<std::uint8_t> rgba;
    std::vector<double> nearness;

    void triangle(const std::array<Corner, 3>& t) {
        const auto edge = [](const Corner& a, const Corner& b, double x, double y) {
            return (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
        };
        const double area = edge(t[0], t[1], t[2][0], t[2][1]);
        if (area == 0) return;
        std::array<double, 3> u, v, normal;
        for (std::size_t k = 0; k < 3; ++k) u[k] = t[1][k] - t[0][k], v[k] = t[2][k] - t[0][k];
        normal = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
        const double size = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
        // The light comes from above (down counts), a little from the right; the side that is seen is nearer.
        const double facing =
            std::copysign(1 / size, normal[2]) * (0.35 * normal[0] - 0.45 * normal[1] + 0.82 * normal[2]);
        const auto shade = [&](double channel) {
            return static_cast<std::uint8_t>(channel * (0.3 + 0.7 * std::clamp(facing, 0.0, 1.0)));
        };
        const auto clip = [](double value, int limit) {
            return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(limit - 1)));
        };
        const int x0 = clip(std::min({t[0][0], t[1][0], t[2][0]}), width),
                  x1 = clip(std::max({t[0][0], t[1][0], t[2][0]}), width);
        const int y0 = clip(std::min({t[0][1], t[1][1], t[2][1]}), height),
                  y1 = clip(std::max({t[0][1], t[1][1], t[2][1]}), height);
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x) {
                const double a = edge(t[1], t[2], x + 0.5, y + 0.5) / area,
                             b = edge(t[2], t[0], x + 0.5, y + 0.5) / area, c = 1 - a - b;
                if (a < 0 || b < 0 || c < 0) continue;
                const double near = a * t[0][2] + b * t[1][2] + c * t[2][2];
                const auto at =
                    static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
                if (near <= nearness[at]) continue;
                nearness[at] = near;
                rgba[4 * at] = shade(240), rgba[4 * at + 1] = shade(150), rgba[4 * at + 2] = shade(40),
                         rgba[4 * at + 3] = 255;
            }
    }
};

}  // namespace

std::vector<std::array<int, 2>> thumbnail_sizes(const std::string& text) {
    std::vector<std::array<int, 2>> sizes;
    if (text.empty() || text == "none") return sizes;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t comma = std::min(text.find(',', from), text.size());
        std::string part = text.substr(from, comma - from);
        if (part.ends_with("/PNG")) part.resize(part.size() - 4);
        int width = 0, height = 0;
        char rest = 0;
        if (part.size() > 11 || std::sscanf(part.c_str(), " %dx%d %c", &width, &height, &rest) != 2 || width < 1 ||
            height < 1 || width > 1000 || height > 1000)
            throw Error(ErrorKind::usage,
                        "thumbnails: '" + part + "' is no size of a PNG; write for example 220x124, sides up to 1000");
        sizes.push_back({width, height});
        from = comma + 1;
    }
    return sizes;
}

std::string thumbnail_png(const std::vector<std::array<Corner, 3>>& triangles, int width, int height) {
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    Picture picture{width, height, std::vector<std::uint8_t>(4 * pixels),
                    std::vector<double>(pixels, -std::numeric_limits<double>::infinity())};
    Corner lo{INFINITY, INFINITY, INFINITY}, hi{-INFINITY, -INFINITY, -INFINITY};
    std::vector<std::array<Corner, 3>> view;
    for (const auto& t : triangles) {
        view.push_back({seen(t[0]), seen(t[1]), seen(t[2])});
        for (const Corner& c : view.back())
            for (std::size_t k = 0; k < 3; ++k) lo[k] = std::min(lo[k], c[k]), hi[k] = std::max(hi[k], c[k]);
    }
    const double scale = 0.92 * std::min(width / std::max(1e-9, hi[0] - lo[0]), height / std::max(1e-9, hi[1] - lo[1]));
    for (auto& t : view) {
        for (Corner& c : t) {
            c[0] = (c[0] - (lo[0] + hi[0]) / 2) * scale + width / 2.0;
            c[1] = (c[1] - (lo[1] + hi[1]) / 2) * scale + height / 2.0;
            c[2] *= scale;
        }
        picture.triangle(t);
    }
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width), image.height = static_cast<png_uint_32>(height);
    image.format = PNG_FORMAT_RGBA;
    png_alloc_size_t bytes = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::string png(bytes, '\0');
    if (!png_image_write_to_memory(&image, png.data(), &bytes, 0, picture.rgba.data(), 0, nullptr))
        throw Error(ErrorKind::cannot_write, std::string("the thumbnail cannot be made (") + image.message +
                                                 "); leave it out with --thumbnails none");
    png.resize(bytes);
    return png;
}

std::string thumbnail_comments(const std::string& png, int width, int height) {
    static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string base64;
    for (std::size_t i = 0; i < png.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < png.size() ? static_cast<std::uint8_t>(png[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) base64 += i + k > png.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
    }
    std::string text = "; thumbnail begin " + std::to_string(width) + "x" + std::to_string(height) + " " +
                       std::to_string(base64.size()) + "\n";
    for (std::size_t i = 0; i < base64.size(); i += 78) text += "; " + base64.substr(i, 78) + "\n";
    return text + "; thumbnail end\n";
}

}  // namespace ribvault
