// tarn report: one page of the results of several runs.
#include "bench/report.h"

#include "commands.h"
#include "session.h"

namespace tarn {
namespace {

struct ReportCommand {
    std::vector<std::string> folders;
    std::string out = "report.html";
};

void run_report(const ReportCommand& command) {
    check_output_folder(command.out);
    std::vector<ReportInput> inputs;
    for (const std::string& folder : command.folders) inputs.push_back(load_results(folder));
    write_report(command.out, inputs);
    fmt::print("The report is {}\n", std::filesystem::absolute(command.out).string());
}

}  // namespace

void add_report_command(CLI::App& app) {
    auto command = std::make_shared<ReportCommand>();
    CLI::App* sub = app.add_subcommand("report", "One page of the results of bench and flythrough");
    sub->add_option("DIR", command->folders,
                    "Folders of bench or flythrough, with results.json and its pictures")
        ->required();
    sub->add_option("--out", command->out, "The page")->capture_default_str();
    sub->callback([command] { run_report(*command); });
}

}  // namespace tarn
