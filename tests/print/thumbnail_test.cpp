#include <catch2/catch.hpp>
#include <png.h>
#include <sstream>
#include <utility>

#include "ribvault/error.hpp"
#include "ribvault/print/thumbnail.hpp"

using namespace ribvault;

namespace {

/// Two triangles that stand as a square of 10 mm facing the front.
const std::vector<std::array<Corner, 3>> square{{Corner{0, 0, 0}, Corner{10, 0, 0}, Corner{10, 0, 10}},
                                                {Corner{0, 0, 0}, Corner{10, 0, 10}, Corner{0, 0, 10}}};

std::string from_base64(const std::string& text) {
    static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (char c : text) {
        if (c == '=') break;
        bits = bits << 6 | static_cast<unsigned>(digits.find(c)), count += 6;
        if (count >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 255);
    }
    return bytes;
}

}  // namespace

TEST_CASE("a thumbnail is a PNG of its size with the model in its middle and nothing in its corners") {
    const std::string png = thumbnail_png(square, 40, 30);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_memory(&image, png.data(), png.size()));
    CHECK(image.width == 40);
    CHECK(image.height == 30);
    image.format = PNG_FORMAT_RGBA;
    std::vector<png_byte> pixels(PNG_IMAGE_SIZE(image));
    REQUIRE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr));
    CHECK(pixels[4 * (15 * 40 + 20) + 3] == 255);
    CHECK(pixels[3] == 0);
    CHECK_NOTHROW(thumbnail_png({}, 16, 16));
}

TEST_CASE("what lies flat is brighter than what stands, whichever way its triangles turn") {
    const auto green_of = [](std::vector<std::array<Corner, 3>> triangles, bool turned) {
        if (turned)
            for (auto& t : triangles) std::swap(t[1], t[2]);
        const std::string png = thumbnail_png(triangles, 40, 40);
        png_image image{};
        image.version = PNG_IMAGE_VERSION;
        REQUIRE(png_image_begin_read_from_memory(&image, png.data(), png.size()));
        image.format = PNG_FORMAT_RGBA;
        std::vector<png_byte> pixels(PNG_IMAGE_SIZE(image));
        REQUIRE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr));
        return pixels[4 * (20 * 40 + 20) + 1];
    };
    const std::vector<std::array<Corner, 3>> roof{{Corner{0, 0, 5}, Corner{10, 0, 5}, Corner{10, 10, 5}},
                                                  {Corner{0, 0, 5}, Corner{10, 10, 5}, Corner{0, 10, 5}}};
    for (const bool turned : {false, true}) {
        CHECK(green_of(roof, turned) > 110);
        CHECK(green_of(roof, turned) > green_of(square, turned) + 10);
        CHECK(green_of(square, turned) > 60);
    }
}

TEST_CASE("its comments hold it in base64, with its size and length") {
    for (const std::size_t length : {0u, 1u, 2u, 3u, 500u}) {
        std::string bytes;
        for (std::size_t i = 0; i < length; ++i) bytes += static_cast<char>(i * 37);
        std::istringstream lines(thumbnail_comments(bytes, 220, 124));
        std::string line, all;
        std::getline(lines, line);
        CHECK(line.rfind("; thumbnail begin 220x124 ", 0) == 0);
        const std::size_t announced = std::stoul(line.substr(26));
        while (std::getline(lines, line) && line != "; thumbnail end") {
            CHECK(line.size() <= 80);
            all += line.substr(2);
        }
        CHECK(line == "; thumbnail end");
        CHECK(all.size() == announced);
        CHECK(from_base64(all) == bytes);
    }
}

TEST_CASE("sizes as people and PrusaSlicer write them") {
    using Sizes = std::vector<std::array<int, 2>>;
    CHECK(thumbnail_sizes("220x124") == Sizes{{220, 124}});
    CHECK(thumbnail_sizes("16x16, 220x124/PNG") == Sizes{{16, 16}, {220, 124}});
    CHECK(thumbnail_sizes("none").empty());
    CHECK(thumbnail_sizes("").empty());
    for (const char* bad : {"220", "0x4", "axb", "16x16,", "2000x16", "16x16x16", "16x16/QOI"})
        CHECK_THROWS_AS(thumbnail_sizes(bad), Error);
}
