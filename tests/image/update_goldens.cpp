// update_goldens [--check] [--exact] [NAME...]: renders the pictures again and shows which goldens changed
// and by how much. Those beyond their tolerance are written, with --exact every one that differs at all.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "image/image_cases.h"
#include "image_io/image_io.h"
#include "metrics/flip.h"
#include "platform/context.h"

namespace tarn::test {
namespace {

struct Options {
    bool check = false;
    bool exact = false;
    std::vector<std::string> only;  // parts of names; empty: all
};

struct Counts {
    int same = 0;
    int changed = 0;
};

bool is_chosen(const Options& options, const ImageSequence& sequence) {
    if (options.only.empty()) return true;
    for (const std::string& part : options.only) {
        if (sequence.name().find(part) != std::string::npos) return true;
    }
    return false;
}

bool must_be_written(const Options& options, const ImageDifference& difference,
                     const ImageTolerance& tolerance) {
    return !difference.passes(tolerance) || (options.exact && difference.max_difference > 0);
}

void update_golden(const Options& options, const ImageTolerance& tolerance, const std::string& name,
                   const Image& actual, Counts& counts) {
    const std::filesystem::path file = golden_file(name);
    const Image expected = std::filesystem::exists(file) ? read_png(file) : Image();
    const ImageDifference difference = compare_display_images(expected, actual, tolerance);
    const bool write = must_be_written(options, difference, tolerance);
    ++(write ? counts.changed : counts.same);
    if (expected.empty()) {
        std::printf("new      %s.png\n", name.c_str());
    } else if (write || difference.max_difference > 0) {
        const double flip =
            difference.same_size ? mean_error(compute_ldr_flip(expected, round_to_8_bits(actual))) : 1.0;
        std::printf("%s %s.png: %s, LDR-FLIP %.4f\n", write ? "changed " : "within  ", name.c_str(),
                    describe(difference, tolerance).c_str(), flip);
    }
    if (write && !options.check) write_png(file, actual);
}

int run(int argc, char** argv) {
    CLI::App app{"Renders the pictures that have goldens, shows what changed, and takes the new ones."};
    Options options;
    app.add_flag("--check", options.check, "Write nothing; exit status 1 when a golden would change");
    app.add_flag("--exact", options.exact,
                 "Take every picture that differs at all, not just beyond its tolerance");
    app.add_option("NAME", options.only, "Only sequences with one of these in their name, such as cornell");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    const auto context = create_context({});
    Counts counts;
    for (const ImageSequence& sequence : image_sequences()) {
        if (!is_chosen(options, sequence)) continue;
        render_sequence(sequence, [&](const std::string& name, const Image& actual) {
            update_golden(options, sequence.tolerance, name, actual, counts);
        });
    }
    std::printf("%d goldens stay, %d %s\n", counts.same, counts.changed,
                options.check ? "would change" : "written: look at them before you commit them");
    return options.check && counts.changed > 0 ? 1 : 0;
}

}  // namespace
}  // namespace tarn::test

int main(int argc, char** argv) {
    try {
        return tarn::test::run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "update_goldens: %s\n", error.what());
        return 1;
    }
}
