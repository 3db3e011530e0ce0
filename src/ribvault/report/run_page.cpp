#include "ribvault/report/run_page.hpp"

#include <zlib.h>

#include <array>
#include <new>

#include "ribvault/report/packed.hpp"
#include "ribvault/report/run_page_files.hpp"

namespace ribvault {
namespace {

/// A text around marks of the form @NAME@.
struct Around {
    std::string_view before, after;
};

Around split(std::string_view text, std::string_view mark) {
    const std::size_t at = text.find(mark);
    return {text.substr(0, at), text.substr(at + mark.size())};
}

}  // namespace

/// Bytes in, base64 of their deflate stream (zlib format) out.
class RunPage::Stream {
public:
    explicit Stream(const std::function<void(std::string_view)>& take) : take_(take) {
        if (deflateInit(&zlib_, Z_BEST_COMPRESSION) != Z_OK) throw std::bad_alloc();
    }
    ~Stream() { deflateEnd(&zlib_); }
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;

    void add(std::string_view bytes) { run(bytes, Z_NO_FLUSH); }
    void end() {
        run({}, Z_FINISH);
        while (rest_.size() % 3 != 0) rest_ += '\0', ++padding_;
        encode(rest_.size());
        text_.resize(text_.size() - padding_);
        text_.append(padding_, '=');
        take_(text_);
    }

private:
    void run(std::string_view bytes, int flush) {
        zlib_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
        zlib_.avail_in = static_cast<uInt>(bytes.size());
        do {
            zlib_.next_out = reinterpret_cast<Bytef*>(out_.data());
            zlib_.avail_out = static_cast<uInt>(out_.size());
            deflate(&zlib_, flush);  // cannot fail: there is room, and the state is of our making
            rest_.append(out_.data(), out_.size() - zlib_.avail_out);
        } while (zlib_.avail_out == 0);
        encode(rest_.size() - rest_.size() % 3);
        if (flush == Z_FINISH) return;
        take_(text_);
        text_.clear();
    }
    /// The first `count` bytes that are left, a multiple of three.
    void encode(std::size_t count) {
        static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        const auto byte = [this](std::size_t k) { return static_cast<unsigned>(static_cast<unsigned char>(rest_[k])); };
        for (std::size_t k = 0; k < count; k += 3) {
            const unsigned three = byte(k) << 16 | byte(k + 1) << 8 | byte(k + 2);
            for (int shift = 18; shift >= 0; shift -= 6) text_ += digits[three >> shift & 63];
        }
        rest_.erase(0, count);
    }

    const std::function<void(std::string_view)>& take_;
    z_stream zlib_{};
    std::array<char, 1 << 15> out_{};
    std::string rest_, text_;
    std::size_t padding_ = 0;
};

RunPage::RunPage(std::function<void(std::string_view)> take) : take_(std::move(take)) {
    const auto [head, body] = split(run_page_html, "@STYLE@");
    take_(head), take_(run_page_style), take_(split(body, "@RUNS@").before);
}

RunPage::~RunPage() = default;

void RunPage::begin_run() {
    take_("<script type=\"text/plain\" id=\"layers" + std::to_string(runs_) + "\">");
    stream_ = std::make_unique<Stream>(take_);
}

void RunPage::add_layer(std::string_view record) { stream_->add(record); }

void RunPage::end_run(std::string_view facts) {
    stream_->end();
    stream_.reset();
    take_("</script>\n<script type=\"application/json\" id=\"facts" + std::to_string(runs_++) + "\">" +
          script_safe(std::string(facts)) + "</script>\n");
}

void RunPage::finish() {
    const auto [before, after] = split(split(run_page_html, "@RUNS@").after, "@SCRIPT@");
    take_(before), take_(run_page_three), take_(run_page_script), take_(after);
}

std::string page_record(std::string_view numbers, std::string_view geometry) {
    Packed out;
    out.text(numbers), out.text(geometry);
    return out.bytes();
}

std::string script_safe(std::string json) {
    for (std::size_t at = json.find('<'); at != std::string::npos; at = json.find('<', at + 1))
        json.replace(at, 1, "\\u003c");
    return json;
}

}  // namespace ribvault
