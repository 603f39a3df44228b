#include "host/app/help.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>

namespace vkdose {

namespace {

const std::map<std::string, std::vector<std::string>>& examples() {
    static const std::map<std::string, std::vector<std::string>> kAll{
        {"new",
         {"vkdose new my.toml                         # asks for the device and the powder",
          "vkdose new my.toml --canister 80x30x100mm --coil 6x5mm",
          "vkdose new my.toml --canister 80x30x100mm --coil 5mm --outlet 20mm --fill 48g --bulk-density 471kg/m3 "
          "--sizes 60/90/130um --flow cohesive",
          "vkdose new my.toml --canister 30x12x25mm --mesh spring.stl --unit mm --dose 0.3g"}},
        {"run",
         {"vkdose run quickstart                      # a case that comes with vkdose; it writes out/quickstart",
          "vkdose run my.toml --set coil.speed_rpm=60 --out out/slow",
          "vkdose run my.toml --live                  # with the bed on the terminal",
          "vkdose run --from out/quickstart --set coil.speed_rpm=60 --out out/slow   # from its settled bed",
          "vkdose run --from out/quickstart --at end --out out/more",
          "vkdose run my.toml --powder powder.toml --draws 16   # figures with intervals"}},
        {"resume",
         {"vkdose resume out/quickstart",
          "vkdose resume out/my --set contact.max_overlap_ratio=0.4   # stopped by a smaller one"}},
        {"check",
         {"vkdose check my.toml                       # figures, and warnings of what was probably not meant",
          "vkdose check my.toml --set settle.time_s=0.2",
          "vkdose check my.toml --assume              # without measuring the device for the run time",
          "vkdose check my.toml --json                # for other programs"}},
        {"devices", {"vkdose devices"}},
        {"export-body",
         {"vkdose export-body quickstart coil --out coil.stl --unit m",
          "vkdose export-body my.toml --time 0.5      # coil and all bodies, as they stand then"}},
        {"sweep",
         {"vkdose sweep study.toml --dry-run          # its members with their hours, and nothing written",
          "vkdose sweep study.toml --set stop.max_doses=2", "vkdose sweep study.toml --jobs 2",
          "vkdose sweep study.toml --retry-failed     # goes on; failed members run again"}},
        {"calibrate", {"vkdose calibrate study.toml                # with a table [calibrate] in the study"}},
        {"design", {"vkdose design study.toml                   # with a table [design] in the study"}},
        {"scale",
         {"vkdose scale my.toml --dry-run             # what it costs, for three runs of four sizes",
          "vkdose scale my.toml --sizes 0.7,1,1.5 --seeds 5"}},
        {"powders",
         {"vkdose powders                             # those that are known",
          "vkdose powders glass-beads                 # all that is known of one",
          "vkdose powders --like bulk=520 tapped=600 drum=45 --out my-powder.toml",
          "vkdose powders my-powder.toml --confirm 6   # held against runs of these tests"}},
        {"studio", {"vkdose studio my-cases                      # prints the address for the browser"}},
        {"report",
         {"vkdose report out/quickstart               # writes out/quickstart/report.html",
          "vkdose report out/quickstart --experiment balance.csv",
          "vkdose report out/slow out/fast             # writes comparison.html"}},
        {"profile", {"vkdose profile bed.jpg --length-mm 60 --check traced.png"}},
        {"render",
         {"vkdose render out/quickstart               # the end of the run",
          "vkdose render out/quickstart --panels --no-coil", "vkdose render out/quickstart --movie film.mp4"}},
        {"manual keys", {"vkdose manual keys                         # of a case", "vkdose manual keys --study"}},
        {"manual columns", {"vkdose manual columns", "vkdose manual columns --sweep"}},
        {"manual options", {"vkdose manual options --brief"}},
        {"manual man",
         {"vkdose manual man run | man -l -", "vkdose manual man test verify | man -l -",
          "vkdose manual man --out ~/.local/share/man/man1"}},
        {"manual completion",
         {"source <(vkdose manual completion bash)           # in ~/.bashrc",
          "vkdose manual completion zsh > ~/.zfunc/_vkdose   # a folder of $fpath",
          "vkdose manual completion fish > ~/.config/fish/completions/vkdose.fish"}},
        {"test verify",
         {"vkdose test verify                         # every known answer, on the device",
          "vkdose test verify --backend reference --only collisions"}},
        {"test validate",
         {"vkdose test validate                       # all comparisons with the literature, at reduced size",
          "vkdose test validate beverloo heap --jobs 2      # goes on where it was interrupted",
          "vkdose test validate dosta-silo --full --out out/full"}},
        {"test bench", {"vkdose test bench --quick", "vkdose test bench --device 0 --out out/bench"}},
        {"test compare", {"vkdose test compare mini --steps 200 --twins 1", "vkdose test compare mini --time 0.05"}},
    };
    return kAll;
}

}  // namespace

std::vector<std::string> examplesOf(const std::string& command) {
    const auto found = examples().find(command);
    return found == examples().end() ? std::vector<std::string>() : found->second;
}

void addExamples(CLI::App& app, const std::string& group) {
    for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        const std::string name = group + command->get_name();
        std::string text = "Examples:";
        for (const std::string& line : examplesOf(name)) text += "\n  " + line;
        if (command->get_subcommands([](const CLI::App*) { return true; }).empty()) command->footer(text);
        addExamples(*command, name + " ");
    }
}

std::string overview(const CLI::App& program) {
    std::string text =
        "vkdose simulates the dosing of cohesive powder by a turning coil.\n\n"
        "A first dose, in about two minutes:\n"
        "  vkdose run quickstart        simulates a small canister and writes out/quickstart\n"
        "  vkdose report out/quickstart writes a page of charts, tables and a player\n\n"
        "A device of your own:\n"
        "  vkdose new my.toml           asks for a device and a powder, and writes a case with its reasons\n"
        "  vkdose check my.toml         what a case implies, with warnings of what was probably not meant\n"
        "  vkdose manual keys           every key of a case file\n\n"
        "Commands:\n";
    for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
        text += fmt::format("  {:<12} {}\n", command->get_name(), command->get_description());
    return text + "\n`vkdose COMMAND --help` shows the options of a command, with examples.\n";
}

}  // namespace vkdose
