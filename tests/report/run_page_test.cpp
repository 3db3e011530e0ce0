// The run page: the layers travel whole, and nothing in the facts can end the script.
#include "ribvault/report/run_page.hpp"

#include <zlib.h>

#include <catch2/catch.hpp>
#include <random>

#include "ribvault/report/packed.hpp"

using namespace ribvault;

namespace {

/// The text of the element with this id.
std::string element(const std::string& page, const std::string& id) {
    const std::size_t at = page.find("id=\"" + id + "\">");
    REQUIRE(at != std::string::npos);
    const std::size_t from = page.find('>', at) + 1;
    return page.substr(from, page.find("</script>", from) - from);
}

std::string from_base64(const std::string& text) {
    static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    REQUIRE(text.size() % 4 == 0);
    REQUIRE(text.find_first_not_of(digits + "=") == std::string::npos);
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (char c : text) {
        if (c == '=') break;
        bits = bits << 6 | static_cast<unsigned>(digits.find(c));
        if ((count += 6) >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 255);
    }
    return bytes;
}

std::string inflated(const std::string& bytes, std::size_t most) {
    std::string out(most, '\0');
    uLongf size = most;
    REQUIRE(uncompress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                       bytes.size()) == Z_OK);
    out.resize(size);
    return out;
}

/// Numbers as src/page/unpack.js reads them.
struct Unpacked {
    const std::string& bytes;
    std::size_t at = 0;
    std::uint64_t natural() {
        std::uint64_t n = 0;
        for (int shift = 0;; shift += 7) {
            const auto b = static_cast<unsigned char>(bytes.at(at++));
            n |= static_cast<std::uint64_t>(b & 127) << shift;
            if (b < 128) return n;
        }
    }
    std::int64_t whole() {
        const std::uint64_t n = natural();
        return n % 2 == 1 ? -static_cast<std::int64_t>(n / 2) - 1 : static_cast<std::int64_t>(n / 2);
    }
};

}  // namespace

TEST_CASE("the page carries every byte of every layer") {
    std::mt19937 random(7);
    for (const std::size_t size : {0u, 1u, 2u, 3u, 1000u, 200000u}) {
        std::string page, all;
        RunPage writer([&page](std::string_view text) { page += text; });
        for (int run = 0; run < 2; ++run) {
            writer.begin_run();
            for (int layer = 0; layer < 3; ++layer) {
                std::string record(size, '\0');
                for (char& c : record) c = static_cast<char>(random());
                writer.add_layer(record);
                if (run == 1) all += record;
            }
            writer.end_run("{}");
        }
        writer.finish();
        CHECK(inflated(from_base64(element(page, "layers1")), 3 * size + 1) == all);
        CHECK(page.find("</html>") != std::string::npos);
    }
}

TEST_CASE("nothing in the facts can end their script element") {
    std::string page;
    RunPage writer([&page](std::string_view text) { page += text; });
    writer.begin_run();
    writer.end_run("{\"name\":\"</script><b>\"}");
    writer.finish();
    CHECK(element(page, "facts0") == "{\"name\":\"\\u003c/script>\\u003cb>\"}");
}

TEST_CASE("packed numbers are read back, the greatest and the least too") {
    const std::int64_t values[] = {0, 1, -1, 63, 64, -64, -65, 1000000, -1000000, INT64_MAX, INT64_MIN};
    Packed packed;
    for (std::int64_t v : values) packed.whole(v);
    packed.natural(UINT64_MAX);
    Unpacked read{packed.bytes()};
    for (std::int64_t v : values) CHECK(read.whole() == v);
    CHECK(read.natural() == UINT64_MAX);
    CHECK(read.at == packed.bytes().size());
}

TEST_CASE("packed points are hundredths of a mm, each relative to the rounded one before") {
    Packed packed;
    packed.points({{499, -499}, {1500, 0}, {1500, 0}, {-100000, 200000}});
    Unpacked read{packed.bytes()};
    CHECK(read.natural() == 4);
    for (const std::int64_t step : {0, 0, 2, 0, 0, 0, -102, 200}) CHECK(read.whole() == step);
}
