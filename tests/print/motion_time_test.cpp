#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "ribvault/print/motion_time.hpp"

using namespace ribvault;

namespace {

MotionLimits limits_of(double acceleration, double jerk) {
    MotionLimits l;
    l.speed = {1000, 1000, 1000, 1000};
    l.acceleration = {1e6, 1e6, 1e6, 1e6};
    l.jerk = {jerk, jerk, jerk, jerk};
    l.print_acceleration = l.retract_acceleration = l.travel_acceleration = acceleration;
    return l;
}

Move move(double x, double y, double speed, double e = 0) { return {{x, y, 0, e}, speed}; }

/// The moves of a G-code file, as far as PrusaSlicer writes them, and the limits in it.
std::vector<Move> moves_of(std::istream& in) {
    std::vector<Move> moves;
    std::array<double, 4> at{};
    double speed = 0;
    bool relative_e = false;
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line.substr(0, line.find(';')));
        std::string word, code;
        words >> code;
        if (code == "M82" || code == "M83") relative_e = code == "M83";
        if (code != "G0" && code != "G1" && code != "G92") continue;
        std::array<double, 4> to = at;
        while (words >> word) {
            const double value = std::atof(word.c_str() + 1);
            const auto axis = std::string("XYZE").find(word[0]);
            if (axis != std::string::npos) to[axis] = axis == 3 && relative_e && code != "G92" ? at[3] + value : value;
            if (word[0] == 'F') speed = value / 60;
        }
        if (code != "G92") moves.push_back({{to[0] - at[0], to[1] - at[1], to[2] - at[2], to[3] - at[3]}, speed});
        at = to;
    }
    return moves;
}

}  // namespace

TEST_CASE("one move is a trapezoid, a short one a triangle") {
    // From the jerk to 100 mm/s at 1000 mm/s2 and back, by hand.
    const MotionLimits l = limits_of(1000, 1e-9);
    CHECK(motion_seconds({move(100, 0, 100)}, l) == Approx(100 / 100.0 + 0.1).epsilon(1e-6));
    CHECK(motion_seconds({move(2.5, 0, 100)}, l) == Approx(2 * std::sqrt(2.5 / 1000)).epsilon(1e-6));
    CHECK(motion_seconds({}, l) == 0);
    CHECK(motion_seconds({move(0, 0, 100)}, l) == 0);
}

TEST_CASE("moves in one direction take as long as one; a corner costs time, a full stop the most") {
    const MotionLimits l = limits_of(1000, 5);
    const double one = motion_seconds({move(40, 0, 80)}, l);
    CHECK(motion_seconds({move(10, 0, 80), move(10, 0, 80), move(20, 0, 80)}, l) == Approx(one));
    const double corner = motion_seconds({move(20, 0, 80), move(0, 20, 80)}, l),
                 back = motion_seconds({move(20, 0, 80), move(-20, 0, 80)}, l);
    CHECK(corner > one);
    CHECK(back >= corner);
    CHECK(back < 2 * motion_seconds({move(20, 0, 80)}, l) + 1e-9);
}

TEST_CASE("limits of an axis slow what uses it") {
    MotionLimits l = limits_of(1e5, 1000);
    l.speed[3] = 5;
    CHECK(motion_seconds({move(10, 0, 100, 10)}, l) == Approx(2).epsilon(0.01));
    l = limits_of(1e5, 1000);
    l.acceleration[2] = 10;
    l.jerk[2] = 1e-9;
    CHECK(motion_seconds({{{0, 0, 2.5, 0}, 100}}, l) == Approx(1).epsilon(0.001));
}

TEST_CASE("tracks, travels and retractions each have their own acceleration") {
    MotionLimits l = limits_of(0, 1e-9);
    l.print_acceleration = 1000, l.travel_acceleration = 500, l.retract_acceleration = 2000;
    CHECK(motion_seconds({move(100, 0, 100, 5)}, l) == Approx(1 + 100 / 1000.0).epsilon(1e-6));
    CHECK(motion_seconds({move(100, 0, 100)}, l) == Approx(1 + 100 / 500.0).epsilon(1e-6));
    CHECK(motion_seconds({move(0, 0, 50, -10)}, l) == Approx(10 / 50.0 + 50 / 2000.0).epsilon(1e-6));
    CHECK(motion_seconds({move(0, 0, 50, 10)}, l) == Approx(10 / 50.0 + 50 / 2000.0).epsilon(1e-6));
}

TEST_CASE("the estimate agrees with PrusaSlicer's own within 10 % on its G-code", "[slow]") {
    namespace fs = std::filesystem;
    if (std::system("command -v prusa-slicer > /dev/null 2>&1") != 0) {
        WARN("prusa-slicer is not installed");
        return;
    }
    const fs::path folder = fs::temp_directory_path() / ("ribvault-time-" + std::to_string(std::rand()));
    fs::create_directories(folder);
    const fs::path cube = fs::path(RIBVAULT_CORPUS).parent_path().parent_path() / "experiments/models/cube20.stl";
    const fs::path bunny = fs::path(RIBVAULT_MODELS) / "low_poly_bunny.stl";
    struct Case {
        fs::path model;
        std::string options;
    };
    std::vector<Case> cases{{cube, "--fill-density 15%"},
                            {cube, "--fill-pattern lightning --perimeters 1"},
                            {cube, "--fill-pattern honeycomb --fill-density 30% --layer-height 0.3"},
                            {cube, "--scale 0.5 --infill-speed 150 --travel-speed 250"},
                            {cube, "--spiral-vase --scale 1.5"}};
    if (*RIBVAULT_MODELS && fs::exists(bunny)) {
        cases.push_back({bunny, "--scale 0.3"});
        cases.push_back({bunny, "--scale 0.3 --fill-pattern gyroid --perimeters 3"});
    }
    int compared = 0;
    for (const Case& c : cases) {
        const fs::path out = folder / "out.gcode";
        const std::string command =
            "prusa-slicer --export-gcode --gcode-flavor marlin2 --use-relative-e-distances=0 --center 100,100 " +
            c.options + " -o " + out.string() + " " + c.model.string() + " > /dev/null 2>&1";
        if (std::system(command.c_str()) != 0) continue;
        std::ifstream in(out);
        std::stringstream text;
        text << in.rdbuf();
        const std::string key = "; estimated printing time (normal mode) = ", all = text.str();
        const std::size_t at = all.find(key);
        REQUIRE(at != std::string::npos);
        std::istringstream words(all.substr(at + key.size(), all.find('\n', at) - at - key.size()));
        double theirs = 0;
        for (std::string word; words >> word;)
            theirs += std::atof(word.c_str()) * (word.back() == 'd'   ? 86400
                                                 : word.back() == 'h' ? 3600
                                                 : word.back() == 'm' ? 60
                                                                      : 1);
        const double ours = motion_seconds(moves_of(text), MotionLimits{});
        INFO(c.model << " " << c.options << ": ours " << ours << " s, theirs " << theirs << " s");
        CHECK(ours == Approx(theirs).epsilon(0.1));
        ++compared;
    }
    fs::remove_all(folder);
    CHECK(compared + 1 >= static_cast<int>(cases.size()));  // some versions refuse one of them
}
