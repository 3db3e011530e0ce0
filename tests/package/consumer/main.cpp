// A program of another project: hollows a model and asks whether the print is proved.
#include <cstdio>
#include <exception>
#include <ribvault/pipeline/generate.hpp>

int main(int argc, char** argv) try {
    if (argc != 2) return 2;
    ribvault::Job job;
    job.model = argv[1];
    job.placement.height_mm = 5;
    const ribvault::RunReport report = ribvault::generate(job);
    std::printf("%zu layers, %s, %.1f mm3 of supports\n", report.layers.size(),
                report.verdict.proved ? "proved" : "not proved", report.totals.support_volume_mm3);
    return report.verdict.proved && report.layers.size() == 25 && report.totals.support_volume_mm3 > 0 ? 0 : 1;
} catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
}
