#include "host/app/command_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "host/app/new_answers.h"
#include "host/app/shared_options.h"

namespace vkdose {

namespace {

CLI::App& addNew(CLI::App& program, NewOptions& options) {
    CLI::App& command =
        *program.add_subcommand("new", "write a commented case from a device and a powder, or ask for them");
    command.add_option("file", options.file, "case to write (TOML); it must not be there yet")
        ->required()
        ->type_name("FILE");
    const auto questions = newQuestions();
    options.answers.resize(questions.size());
    for (std::size_t i = 0; i < questions.size(); ++i) {
        const NewQuestion& q = questions[i];
        const std::string standard = q.standard == nullptr ? "" : fmt::format(" (default: {})", q.standard);
        command.add_option(q.option, options.answers[i], q.meaning + standard)->type_name(q.form);
    }
    command.add_flag("--ask", options.ask,
                     "ask for what is not given; without any option this is done on a terminal anyway");
    for (std::size_t i = 0; i < kDeviceTemplates.size(); ++i)
        command.add_flag(fmt::format("--{}", kDeviceTemplates[i].name), options.devices[i],
                         fmt::format("alone: {}", kDeviceTemplates[i].about));
    for (std::size_t i = 0; i < kStudyTemplates.size(); ++i)
        command
            .add_option(fmt::format("--{}", kStudyTemplates[i].command), options.studies[i],
                        fmt::format("alone: {}", kStudyTemplates[i].about))
            ->type_name("CASE");
    return command;
}

CLI::App& addRun(CLI::App& program, RunOptions& options) {
    CLI::App& command = *program.add_subcommand("run", "simulate a case and write its output folder");
    addCase(command, options.input).required(false);
    auto* from = command
                     .add_option("--from", options.from.folder,
                                 "begin with the powder of the run in this output folder, contacts included; "
                                 "without CASE with its case, changed by --set")
                     ->type_name("DIR");
    command
        .add_option(
            "--at", options.from.at,
            "its state to begin with: settled, checkpoint or end (default: the first of these that it has), or a "
            "time [s]: the nearest frame, if the case keeps frames.states")
        ->type_name("STATE|TIME")
        ->needs(from);
    command.add_option("--out", options.out, "output folder (default: out/<case name> in the current folder)")
        ->type_name("DIR");
    command.add_flag("--force", options.force,
                     "replace a former run in the output folder: its files, and none that vkdose did not write");
    addShow(command, options.quiet, options.live, options.events, options.orders);
    command.add_option("--member", options.member, "number of the run in a study")->group("");
    addParent(command, options.parent);
    auto* draws = command
                      .add_option("--draws", options.draws,
                                  "so many runs, each with another draw from the distribution of the powder's "
                                  "parameters and another seed: figures with 95 % intervals (default: one run)")
                      ->check(CLI::Range(2, 1000))
                      ->needs("--powder")
                      ->excludes(from)
                      ->excludes("--live")
                      ->excludes("--events")
                      ->excludes("--force");
    for (CLI::Option* option : addMemberOptions(command, options.ofDraws)) option->needs(draws);
    addBackend(command, options.backend);
    from->excludes("--backend");  // the state is that of one backend
    return command;
}

CLI::App& addResume(CLI::App& program, ResumeOptions& options) {
    CLI::App& command = *program.add_subcommand("resume", "go on with an interrupted run from its checkpoint");
    command.add_option("dir", options.folder, "output folder of the run")->required()->type_name("DIR");
    addSet(command, options.overrides,
           "replace a value that changes nothing of the past: contact.max_overlap_ratio, stop.*, checkpoint.*; may be "
           "repeated");
    addShow(command, options.quiet, options.live, options.events, options.orders);
    addParent(command, options.parent);
    addDevice(command, options.backend);
    return command;
}

CLI::App& addCheck(CLI::App& program, CheckOptions& options) {
    CLI::App& command = *program.add_subcommand(
        "check", "validate a case; print its figures, and warnings of what was probably not meant");
    addCase(command, options.input);
    addAssume(command, options.assume);
    auto* json =
        command.add_flag("--json", options.json, "print errors, warnings and figures as JSON, for other programs");
    command.add_flag("--scene", options.scene, "the device and its powder too, as the player of a report takes them")
        ->needs(json);
    addBackend(command, options.backend);
    return command;
}

CLI::App& addExportBody(CLI::App& program, ExportBodyOptions& options) {
    CLI::App& command = *program.add_subcommand(
        "export-body", "write coil and bodies of a case as a binary STL mesh, for other programs");
    addCase(command, options.input);
    command.add_option("name", options.names, "names of bodies, or `coil`; without a name all are written");
    command.add_option("--out", options.out, "mesh to write")->type_name("FILE")->capture_default_str();
    command.add_option("--unit", options.unit, "unit of the mesh's lengths, which STL itself cannot tell")
        ->check(CLI::IsMember({"mm", "m", "um", "cm", "inch"}))
        ->capture_default_str();
    command
        .add_option("--time", options.time,
                    "time at which moving bodies are shown [s]; of bodies that move in phases, the time for which they "
                    "have moved")
        ->capture_default_str();
    command.add_option("--angle", options.angle, "angle of the drive at which coil and driven bodies are shown [deg]")
        ->capture_default_str();
    command.add_option("--around", options.around, "corners of a wire's cross-section")
        ->check(CLI::Range(3, 1000))
        ->capture_default_str();
    command.add_option("--per-turn", options.perTurn, "straight pieces of a full turn, of round bodies too")
        ->check(CLI::Range(4, 10000))
        ->capture_default_str();
    return command;
}

CLI::App& addPowders(CLI::App& program, PowdersOptions& options) {
    CLI::App& command =
        *program.add_subcommand("powders", "list the powders that are known, or tell all that is known of one");
    auto* name = command.add_option("powder", options.name, "name of a powder, or a powder file (TOML)");
    auto* like = command
                     .add_option("--like", options.like,
                                 "find a powder by what a laboratory measured of it: bulk=520 tapped=640 repose=48+-2")
                     ->type_name("FIGURE=VALUE")
                     ->excludes(name);
    command.add_option("--out", options.out, "powder file to write it to (TOML); it must not be there yet")
        ->type_name("FILE")
        ->needs(like);
    auto* confirm = command
                        .add_option("--confirm", options.confirm,
                                    "run the element tests of its laboratory figures, each with so many of its draws, "
                                    "and write into its file what they say")
                        ->check(CLI::Range(2, 1000))
                        ->needs(name)
                        ->excludes(like);
    command.add_flag("--json", options.json, "print the list as JSON")->excludes(name)->excludes(like);
    for (CLI::Option* option : addMemberOptions(command, options.ofConfirm)) option->needs(confirm);
    addBackend(command, options.backend);
    return command;
}

CLI::App& addStudio(CLI::App& program, StudioOptions& options) {
    CLI::App& command = *program.add_subcommand("studio", "serve the workbench to the browser of this machine");
    command.add_option("folder", options.folder, "folder with the cases")->type_name("DIR")->capture_default_str();
    command.add_option("--port", options.port, "port to listen on (default: any that is free)")
        ->check(CLI::Range(1, 65535));
    return command;
}

CLI::App& addReport(CLI::App& program, ReportOptions& options) {
    CLI::App& command = *program.add_subcommand(
        "report", "write an HTML report of a run or a sweep, or of several runs beside each other");
    command
        .add_option("source", options.sources,
                    "output folder of a run or a sweep, or a study's file; several folders of runs are compared")
        ->required()
        ->type_name("DIR|STUDY");
    command
        .add_option(
            "--out", options.out,
            "page to write (default: report.html in the folder; of several runs comparison.html in the current one)")
        ->type_name("FILE");
    command.add_option("--experiment", options.experiment, "readings of a balance (CSV), shown beside a run's doses")
        ->type_name("FILE");
    command.add_option("--expected", options.expected, "table of published results (TOML), by which a sweep is judged")
        ->type_name("FILE");
    command
        .add_option("--profile", options.profiles,
                    "surface measured on a photograph (CSV), shown beside the run's after this dose (0: the settled "
                    "bed; default: the last dose); may be repeated")
        ->type_name("FILE[@DOSE]")
        ->allow_extra_args(false);
    return command;
}

CLI::App& addProfile(CLI::App& program, ProfileOptions& options) {
    CLI::App& command = *program.add_subcommand("profile", "trace the surface of the powder in a photograph");
    photo::Reading& reading = options.reading;
    command.add_option("photo", options.photos, "PNG, JPEG or TIFF; of several of one scene the mean is read")
        ->required();
    command
        .add_option_function<std::vector<int>>(
            "--roi",
            [&reading](const std::vector<int>& r) {
                reading.region = photo::Region{r[0], r[1], r[2], r[3]};
            },
            "region in pixels: left, top, width, height (default: the whole picture)")
        ->delimiter(',')
        ->expected(4)
        ->type_name("X,Y,W,H");
    auto* scale = command.add_option("--mm-per-pixel", reading.mmPerPixel,
                                     "size of a pixel [mm]; this or --length-mm is required");
    command.add_option("--length-mm", reading.lengthMm, "length that the region's width stands for [mm]")
        ->excludes(scale);
    command
        .add_option("--threshold", reading.threshold,
                    "grey of the picture as it is, below which a pixel counts as dark (default: found, in even light)")
        ->check(CLI::Range(1, 255));
    command
        .add_option_function<std::string>(
            "--powder",
            [&reading](const std::string& kind) {
                reading.powder = kind == "dark" ? photo::Powder::Dark : photo::Powder::Light;
            },
            "whether the powder is dark or light (default: the kind of pixel that lies lower)")
        ->check(CLI::IsMember({"dark", "light"}));
    command
        .add_option_function<std::string>(
            "--rear", [&reading](const std::string& side) { reading.rearLeft = side == "left"; },
            "side of the picture on which the rear wall is (default: left)")
        ->check(CLI::IsMember({"left", "right"}));
    command
        .add_option_function<std::vector<double>>(
            "--corner-mm",
            [&reading](const std::vector<double>& corner) {
                reading.cornerZMm = corner[0];
                reading.cornerHeightMm = corner[1];
            },
            "place of the region's lower corner at the rear, from the rear wall and the lowest point [mm] (default: "
            "0,0)")
        ->delimiter(',')
        ->expected(2)
        ->type_name("Z,H");
    command
        .add_option("--speck-mm", reading.speckMm, "patches and holes smaller than a square of this edge are dirt [mm]")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command.add_option("--out", options.out, "surface to write (CSV)")->type_name("FILE")->capture_default_str();
    command
        .add_option("--check", options.check,
                    "picture to write, with the surface drawn over the photograph, to judge it by")
        ->type_name("FILE");
    return command;
}

CLI::App& addRender(CLI::App& program, RenderOptions& options) {
    CLI::App& command =
        *program.add_subcommand("render", "draw pictures and films of a run, or of a case before it runs");
    command
        .add_option("run", options.input.file,
                    "output folder of a run; or a case, by its file or its name: its device and its powder before "
                    "anything moves")
        ->required()
        ->type_name("DIR|FILE");
    addSet(command, options.input.overrides, "replace a value of the case that is drawn; may be repeated");
    command
        .add_option("--out", options.out,
                    "picture to write, a PNG (default: picture.png in the folder; of a case its name in the current "
                    "folder)")
        ->type_name("FILE");
    auto* times =
        command
            .add_option(
                "--time", options.times,
                "simulated time [s], one or several side by side; the nearest frames are drawn (default: the end)")
            ->expected(1, 26);
    auto* panels = command
                       .add_flag("--panels", options.panels,
                                 "four times side by side: settled, end of the first dose's turning, half of the "
                                 "powder that came out is out, a tenth left")
                       ->excludes(times);
    auto* movie = command
                      .add_option("--movie", options.movie,
                                  "all frames: a film, encoded by ffmpeg if that is installed, or a folder of pictures "
                                  "that holds no frame_*.png yet")
                      ->type_name("FILE|DIR")
                      ->excludes(times)
                      ->excludes(panels)
                      ->excludes("--out");
    command.add_option("--rate", options.rate, "frames a second of the film")
        ->check(CLI::Range(0.1, 240.0))
        ->capture_default_str()
        ->needs(movie);
    command
        .add_option(
            "--color", options.color,
            "quantity that the colour tells: kinetic-energy, speed, overlap, radius, fill-layer, powder, or what "
            "a law of one's own gives each particle (default: kinetic-energy; of a case radius, or powder if it "
            "has several)")
        ->option_text("NAME");
    command.add_option("--from", options.from, "value where the colours begin, in the unit of the colour bar");
    command.add_option("--to", options.to, "value where the colours end");
    command.add_option("--view", options.view, "side from which the picture is drawn")
        ->check(CLI::IsMember({"side", "end", "iso", "cut", "cut-end"}))
        ->capture_default_str();
    command
        .add_option("--size", options.size,
                    "width and height in pixels: 1280x720 (default: as large as the view takes)")
        ->type_name("WxH");
    command.add_flag("--no-coil", options.noCoil, "do not draw the coil");
    addDevice(command, options.backend);
    return command;
}

}  // namespace

std::vector<Command> declareCommands(CLI::App& program, Options& o) {
    std::vector<Command> all{
        {&addNew(program, o.made), [&o] { return newCommand(o.made); }},
        {&addRun(program, o.run),
         [&o] { return o.run.draws > 0 ? drawsCommand(named(o.run)) : runCommand(named(o.run)); }},
        {&addResume(program, o.resume), [&o] { return resumeCommand(o.resume); }},
        {&addCheck(program, o.check), [&o] { return checkCommand(named(o.check)); }},
        {program.add_subcommand("devices", "list the Vulkan devices"), [] { return devicesCommand(); }},
        {&addExportBody(program, o.exportBody), [&o] { return exportBodyCommand(named(o.exportBody)); }},
    };
    const auto also = [&all](std::vector<Command> commands) {
        all.insert(all.end(), commands.begin(), commands.end());
    };
    also(declareStudies(program, o));
    also({
        {&addStudio(program, o.studio), [&o] { return studioCommand(o.studio); }},
        {&addPowders(program, o.powders), [&o] { return powdersCommand(o.powders); }},
        {&addReport(program, o.report), [&o] { return reportCommand(o.report); }},
        {&addProfile(program, o.profile), [&o] { return profileCommand(o.profile); }},
        {&addRender(program, o.render), [&o] { return renderCommand(o.render); }},
    });
    also(declareManual(program, o));
    also(declareTests(program, o));
    return all;
}

}  // namespace vkdose
