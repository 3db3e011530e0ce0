#include "ribvault/print/read_gcode.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <utility>

#include "ribvault/error.hpp"
#include "ribvault/input_stream.hpp"
#include "ribvault/print/gcode_arcs.hpp"
#include "ribvault/print/gcode_comments.hpp"
#include "ribvault/print/gcode_layers.hpp"
#include "ribvault/print/gcode_machine.hpp"

namespace ribvault {
namespace {

constexpr double usual_filament = 1.75;             // mm
constexpr double usual_nozzle = 0.4;                // mm
constexpr std::uint64_t moves_to_see = 10000;
constexpr double widest_track = 3;                  // nozzles; the flat around the hole is hardly wider
constexpr std::int64_t farthest = 10000;            // mm from the origin; no printer's bed reaches so far
constexpr std::size_t block_size = 1 << 18;         // bytes
constexpr std::size_t longest_line = 1 << 20;       // bytes; thumbnails have lines of 80, settings of some thousand

double distance(const std::array<Decimal, 3>& a, const std::array<Decimal, 3>& b) {
    return std::hypot(to_double(b[0] - a[0]), to_double(b[1] - a[1]));
}

class Reader {
public:
    Reader(std::string name, const GcodeOptions& options) : name_(std::move(name)), options_(options) {}

    /// A piece of the file; pieces need not end where lines do.
    void feed(std::string_view text) {
        if (print_.bytes == 0) refuse_other_formats(text);
        print_.bytes += text.size();
        if (std::memchr(text.data(), 0, text.size()) != nullptr)
            fail("holds zero bytes: it is not text", "export it as plain G-code");
        while (!text.empty()) {
            const std::size_t end = text.find('\n');
            if (end == std::string_view::npos) {
                rest_ += text;
                if (rest_.size() > longest_line)
                    fail("has a line of more than 1 MB: it is no G-code", "export it as plain G-code");
                return;
            }
            if (rest_.empty()) {
                line(text.substr(0, end));
            } else {
                rest_ += text.substr(0, end);
                line(rest_);
                rest_.clear();
            }
            text.remove_prefix(end + 1);
        }
    }

    GcodePrint finish() {
        if (print_.bytes == 0) fail("the file is empty", "export the G-code again");
        if (!rest_.empty()) last_line();
        if (print_.cut.empty()) print_.cut = comments_.missing_end();
        if (collector_.empty()) fail_without_extrusions();
        print_.features = comments_.features;
        print_.flavour = comments_.flavour;
        print_.program = comments_.program;
        print_.nozzles = comments_.nozzles;
        print_.filaments = comments_.filaments;
        LayerHints hints;
        hints.layer_height = comments_.layer_height, hints.first_layer_height = comments_.first_layer_height;
        hints.filaments = comments_.filaments, hints.volumetric = comments_.volumetric;
        hints.infill_layers = options_.infill_layers;
        if (!comments_.nozzles.empty())
            hints.nozzle = to_double(*std::max_element(comments_.nozzles.begin(), comments_.nozzles.end()));
        hints.widest_track =
            std::llround(widest_track * pm_per_mm * options_.nozzle.value_or(hints.nozzle.value_or(usual_nozzle)));
        if (options_.filament_diameter) hints.filaments = {*options_.filament_diameter};
        if (hints.filaments.empty()) hints.filaments = {usual_filament};
        if (!hints.layer_height && options_.layer_height)
            hints.layer_height = std::llround(*options_.layer_height * 1000) * 1000000;
        print_.filament_diameter = hints.filaments.front();
        collector_.finish(print_, hints);
        return std::move(print_);
    }

private:
    [[noreturn]] void fail(const std::string& what, const std::string& remedy) const {
        throw Error(ErrorKind::unreadable, name_ + ": " + what + "; " + remedy);
    }
    [[noreturn]] void fail_line(const std::string& what) const {
        throw Error(ErrorKind::unreadable, name_ + ", line " + std::to_string(print_.lines) + ": " + what);
    }

    void refuse_other_formats(std::string_view text) const {
        if (text.starts_with("GCDE"))
            fail("is binary G-code", "switch off 'binary G-code' in the slicer, or convert it to .gcode");
        if (text.starts_with("PK\3\4")) fail("is a ZIP archive, as .3mf files are", "unpack the .gcode file in it");
        const std::size_t first = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
        if (first != std::string_view::npos && text[first] == '{')
            fail("is JSON, no G-code", "name a .gcode file; a layers file is for `ribvault page`");
        const std::string_view start = text.substr(0, 4096);
        const auto odd = std::count_if(start.begin(), start.end(), [](char c) {
            return static_cast<unsigned char>(c) < 32 && c != '\t' && c != '\n' && c != '\r' && c != '\f';
        });
        if (static_cast<std::size_t>(odd) * 50 > start.size())
            fail("is no text: it is not G-code", "name a .gcode file");
    }

    [[noreturn]] void fail_without_extrusions() const {
        if (print_.set_aside_mm > 0) fail("extrudes nothing but start and custom G-code", "export the G-code again");
        if (motions_ > 0) fail("moves, but never extrudes", "export the G-code again");
        fail("holds no move (G0 to G3) in " + std::to_string(print_.lines) + " lines: it is not G-code",
             "name a .gcode file");
    }

    void line(std::string_view text) {
        ++print_.lines;
        if (print_.lines == 1 && text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
        if (const std::string wrong = scan_line(text, words_); !wrong.empty()) fail_line(wrong);
        obey();
    }

    /// The last line, without its line end: a motion in it may have lost digits.
    void last_line() {
        ++print_.lines;
        const bool good = scan_line(rest_, words_).empty();
        const bool motion = words_.letter == 'G' && words_.code <= 3;
        if (!good || motion)
            print_.cut = "it ends in the middle of line " + std::to_string(print_.lines);
        else
            obey();
    }

    void obey() {
        if (words_.letter == 0) {
            if (!words_.comment.empty()) read_marks([&] { comments_.read(words_.comment); });
            return;
        }
        if (const std::string wrong = machine_.apply(words_, motion_); !wrong.empty()) fail_line(wrong);
        if (motion_.kind == GcodeMotion::Kind::none) return;
        ++motions_;
        if (!words_.comment.empty()) read_marks([&] { comments_.read_behind_move(words_.comment); });
        move();
    }

    /// All before the first layer or feature that is named was start G-code.
    template <class Read>
    void read_marks(const Read& read) {
        const bool marked = comments_.marked;
        read();
        if (!marked && comments_.marked) print_.set_aside_mm += collector_.set_aside();
    }

    void move() {
        const bool arc = motion_.kind != GcodeMotion::Kind::line;
        const bool flat = motion_.moves_flat() || arc;
        if (!flat) {
            if (motion_.moves_up()) collector_.end_path();
            if (motion_.pushed != 0) push_at_rest();
            return;
        }
        if (motion_.pushed <= 0) {
            collector_.end_path();
            if (motion_.pushed < 0) retracted_ = true;
            return;
        }
        retracted_ = false;
        see_last_decimals();
        if (print_.lines > std::numeric_limits<std::uint32_t>::max()) fail("has more than 4 billion lines", "split it");
        Extrusion e = extrusion();
        for (const auto* end : {&motion_.from, &motion_.to})
            for (const Decimal& d : *end)
                if (d.value > farthest * Int128{decimal_one} || d.value < -farthest * Int128{decimal_one})
                    fail_line(
                        "extrudes more than 10 m from the origin, where no printer is; expected a place on a bed");
        if (!arc) {
            e.length_mm = distance(e.from, e.to);
            extrude(e);
            return;
        }
        double length = 0;
        if (const std::string wrong = arc_points(motion_, points_, length); !wrong.empty()) fail_line(wrong);
        e.chord = true;
        const double pushed = length > 0 ? motion_.pushed / length : 0;
        for (const std::array<Decimal, 3>& p : points_) {
            e.to = p;
            e.length_mm = length / static_cast<double>(points_.size());
            e.pushed = pushed * e.length_mm;
            if (e.from[0] != e.to[0] || e.from[1] != e.to[1]) extrude(e);
            e.from = p;
        }
    }

    /// The last decimals that are written, from the third on; a few thousand moves show them.
    void see_last_decimals() {
        if (motions_ > moves_to_see) return;
        const auto see = [&](char letter, Int128& step) {
            if (words_.has(letter))
                while (words_[letter].value % step != 0) step /= 10;
        };
        see('E', pushed_step_), see('X', length_step_), see('Y', length_step_);
        last_of_e_ = to_double({pushed_step_}), last_of_places_ = to_double({length_step_});
    }

    Extrusion extrusion() const {
        Extrusion e;
        const double unit = machine_.in_inches() ? 25.4 : 1;
        e.pushed_step = last_of_e_ * unit * (motion_.volumetric ? unit * unit : 1);
        e.length_step = last_of_places_ * unit;
        e.from = motion_.from, e.to = motion_.to;
        e.pushed = motion_.pushed;
        e.volumetric = motion_.volumetric;
        e.tool = motion_.tool;
        e.feature = comments_.feature;
        e.width = comments_.width;
        e.height = comments_.height;
        if (comments_.raft && comments_.layer) e.over_raft = std::clamp(*comments_.layer + 1, 0, 3);
        e.line = static_cast<std::uint32_t>(print_.lines);
        return e;
    }

    void extrude(const Extrusion& e) {
        if (comments_.features[e.feature].kind == FeatureKind::custom)
            print_.set_aside_mm += e.length_mm;
        else
            collector_.extrude(e);
    }

    /// Retraction, priming, or, in ribvault's files, a dot: what is pushed at rest while nothing is retracted.
    void push_at_rest() {
        const bool primes = std::exchange(retracted_, motion_.pushed < 0);
        if (motion_.pushed < 0 || primes || motion_.moves_up()) {
            collector_.end_path();
            return;
        }
        if (comments_.flavour != GcodeFlavour::ribvault || !comments_.width) return;
        collector_.end_path();
        extrude(extrusion());
        collector_.end_path();
    }

    std::string name_;
    const GcodeOptions& options_;
    GcodePrint print_;
    GcodeComments comments_;
    GcodeMachine machine_;
    LayerCollector collector_;
    GcodeWords words_;
    GcodeMotion motion_;
    std::vector<std::array<Decimal, 3>> points_;
    std::string rest_;  ///< of a line whose end has not come yet
    std::uint64_t motions_ = 0;
    Int128 pushed_step_ = decimal_one / 1000, length_step_ = decimal_one / 1000;
    double last_of_e_ = 0, last_of_places_ = 0;  ///< the same, in the file's unit
    bool retracted_ = true;
};

}  // namespace

GcodePrint read_gcode(std::string_view text, const std::string& name, const GcodeOptions& options) {
    Reader reader(name, options);
    reader.feed(text);
    return reader.finish();
}

GcodePrint read_gcode(const std::filesystem::path& file, const GcodeOptions& options) {
    std::ifstream stream = open_input(file, "G-code");
    Reader reader(file.string(), options);
    std::string block(block_size, '\0');
    while (stream) {
        stream.read(block.data(), static_cast<std::streamsize>(block.size()));
        if (stream.gcount() > 0)
            reader.feed(std::string_view(block).substr(0, static_cast<std::size_t>(stream.gcount())));
    }
    check_read(stream, file);
    return reader.finish();
}

}  // namespace ribvault
