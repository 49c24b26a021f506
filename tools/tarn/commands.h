// The subcommands of `tarn`, one file each.
#pragma once

#include <CLI/CLI.hpp>

namespace tarn {

// Each adds its subcommand with options and a callback that runs it. A callback throws Error where a file,
// a driver or a disk fails; main turns that into one line and exit status 1.
void add_info_command(CLI::App& app);
void add_render_command(CLI::App& app);
void add_reference_command(CLI::App& app);
void add_compare_command(CLI::App& app);
void add_bench_command(CLI::App& app);
void add_flythrough_command(CLI::App& app);
void add_floors_command(CLI::App& app);
void add_report_command(CLI::App& app);
void add_study_command(CLI::App& app);
void add_view_command(CLI::App& app);

}  // namespace tarn
