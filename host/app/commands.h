#pragma once
// One function per command of the program. Each returns an exit code and throws errors that command_line.cpp turns into
// one.

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/app/backends.h"
#include "host/app/command_table.h"
#include "host/app/new_study.h"
#include "host/app/new_template.h"
#include "host/app/time_limit.h"
#include "host/photo/profile.h"

namespace vkdose {

struct CaseOptions {
    std::filesystem::path file;
    std::vector<std::string> overrides;  ///< "key.path=value"
    std::filesystem::path powder = {};   ///< file of a powder that takes the place of the case's; empty: none
};

struct NewOptions {
    std::filesystem::path file;
    std::vector<std::string> answers;                     ///< to newQuestions(), in their order; empty: not given
    bool ask = false;                                     ///< for what is not given, even if nobody sits at a terminal
    std::array<bool, kDeviceTemplates.size()> devices{};  ///< a device that is ready; then nothing else
    /// The case of a study that is to be written; then nothing else.
    std::array<std::filesystem::path, kStudyTemplates.size()> studies;
};

/// How the members of a sweep run, or the draws of a powder.
struct MemberOptions {
    int jobs = 0;                    ///< at once, in processes; 0: one for each core, if those are what it takes
    int ensemble = 0;                ///< at once that share the device; 0: on a GPU as many as fit
    std::optional<TimeLimit> limit;  ///< of the command's wall time
    bool retryFailed = false;
};

/// A run whose powder another run begins with.
struct StartOptions {
    std::filesystem::path folder;  ///< of its output; empty: the run begins with a filled canister
    std::string at;  ///< "settled", "checkpoint", "end" or a time [s]; empty: the first of these that there is
};

struct RunOptions {
    CaseOptions input;
    StartOptions from;
    BackendChoice backend;
    std::filesystem::path out;  ///< empty: out/<case name>
    bool force = false;
    bool quiet = false;
    bool live = false;                    ///< the bed on the terminal
    bool events = false;                  ///< JSON lines on stdout in place of all text there
    bool orders = false;                  ///< obeys lines on stdin
    int parent = 0;                       ///< process with which this one ends, as by Ctrl-C; 0: none
    std::optional<std::uint32_t> member;  ///< number in a study
    int draws = 0;                        ///< runs with so many draws of the powder in place of one; 0: one
    MemberOptions ofDraws;
};

struct ResumeOptions {
    std::filesystem::path folder;
    std::vector<std::string> overrides;  ///< "key.path=value", of keys that do not change what has been
    BackendChoice backend;               ///< its backend is the checkpoint's
    bool quiet = false;
    bool live = false;    ///< as above
    bool events = false;  ///< as above
    bool orders = false;  ///< as above
    int parent = 0;       ///< as above
};

struct CheckOptions {
    CaseOptions input;
    BackendChoice backend;
    bool assume = false;  ///< a speed, without measuring the device
    bool json = false;    ///< print errors, warnings and figures for other programs
    bool scene = false;   ///< with json: the device and its powder too, as the player of a report takes them
};

struct CompareOptions {
    CaseOptions input;
    BackendChoice backend;    ///< the candidate
    std::uint64_t steps = 0;  ///< 0: see `time`
    double time = 0;          ///< [s]; 0: settling and the first dose
    int twins = 3;            ///< rough ones, see sim/comparison.h
};

struct VerifyOptions {
    BackendChoice backend;
    std::filesystem::path out = "out/verify";
    std::string only;   ///< part of the name of the cases to play; empty: all
    bool list = false;  ///< tell which cases there are, and play none
};

/// The settled bed that comes with the project, seen from its folder.
inline constexpr const char* kSettledBed = "tools/bench-data/bed-48g.toml";

struct BenchOptions {
    BackendChoice backend;  ///< a Vulkan device
    std::filesystem::path out = "out/bench";
    std::filesystem::path bed;  ///< case of a settled bed; empty: the project's, if this is its folder
    std::string only;           ///< part of the name of the workloads to run; empty: all
    int repeats = 5;
    int copies = 1;      ///< processes side by side, each with the workload for itself
    int members = 1;     ///< canisters in one ensemble, ditto
    bool quick = false;  ///< the small workloads, a fraction of a second each: does it work at all
};

struct ExportBodyOptions {
    CaseOptions input;
    std::vector<std::string> names;  ///< of bodies, or "coil"; empty: all
    std::filesystem::path out = "body.stl";
    std::string unit = "mm";
    double time = 0;   ///< [s]
    double angle = 0;  ///< of the drive [degrees]
    int around = 10;   ///< corners of a wire
    int perTurn = 64;  ///< pieces of a turn
};

struct SweepOptions : MemberOptions {
    std::filesystem::path study;
    std::vector<std::string> overrides;  ///< "key.path=value", for every member
    BackendChoice backend;
    std::filesystem::path out;  ///< empty: out/<name of the study's file>
    bool mpi = false;           ///< a member on each rank of an MPI job instead
    std::string again;          ///< the command that goes on, without what all have; empty: that of the sweep itself
    bool prepare = false;       ///< only make the members' folders
    bool dryRun = false;
    bool assume = false;  ///< a speed, without measuring the device, for the hours of a dry run
    bool quiet = false;
};

struct ScaleOptions {
    SweepOptions sweep;  ///< `study` is the case
    std::vector<double> factors{1, 1.5, 2, 3};
    int seeds = 3;
    double within = 5;  ///< [%]
};

struct StudioOptions {
    std::filesystem::path folder = ".";
    int port = 0;  ///< 0: any that is free
};

struct PowdersOptions {
    std::filesystem::path name;     ///< of a powder; empty: all are listed
    std::vector<std::string> like;  ///< "repose=48": figures of a powder that is to be found
    std::filesystem::path out;      ///< of it as a powder file; empty: none is written
    bool json = false;              ///< the list for other programs
    int confirm = 0;                ///< draws with which the element tests are run; 0: none are
    MemberOptions ofConfirm;
    BackendChoice backend;
};

struct ReportOptions {
    std::vector<std::filesystem::path> sources;  ///< folder of a run or a sweep, or a study's file; or several runs
    std::filesystem::path out;                   ///< empty: report.html in the folder, of several comparison.html
    std::optional<std::filesystem::path> experiment;  ///< a balance's readings
    std::optional<std::filesystem::path> expected;    ///< published results
    std::vector<std::string> profiles;                ///< surfaces measured on photographs, "FILE" or "FILE@DOSE"
};

struct ProfileOptions {
    std::vector<std::filesystem::path> photos;  ///< of one scene; their mean is read
    photo::Reading reading;
    std::filesystem::path out = "profile.csv";
    std::filesystem::path check;  ///< empty: no picture to judge by
};

struct RenderOptions {
    CaseOptions input;            ///< its file may be the output folder of a run
    BackendChoice backend;        ///< its device
    std::filesystem::path out;    ///< empty: picture.png in the folder; of a case its name.png here
    std::vector<double> times;    ///< [s]; none: the end
    bool panels = false;          ///< instead four times that tell the run's story
    std::filesystem::path movie;  ///< a film, or without a suffix a folder; empty: none
    double rate = 25;             ///< pictures of a film in a second
    std::string color;            ///< empty: kinetic-energy, of a case radius or powder
    std::string view = "side";
    std::string size;  ///< "1280x720"; empty: as large as what is to be seen takes
    bool noCoil = false;
    std::optional<double> from, to;  ///< ends of the colour bar, in its unit
};

/// What `vkdose manual completion` and `vkdose manual man` print.
struct ShellOptions {
    std::string shell;
    std::string names;                 ///< instead: the names of "case" or "study"
    std::vector<std::string> command;  ///< its words
    std::filesystem::path out;
};

int newCommand(const NewOptions& options);
int runCommand(const RunOptions& options);
int drawsCommand(const RunOptions& options);  ///< a run with draws
int studioCommand(const StudioOptions& options);
int powdersCommand(const PowdersOptions& options);
int resumeCommand(const ResumeOptions& options);
int checkCommand(const CheckOptions& options);
int devicesCommand();
int compareCommand(const CompareOptions& options);
int verifyCommand(const VerifyOptions& options);
int benchCommand(const BenchOptions& options);
int exportBodyCommand(const ExportBodyOptions& options);
int sweepCommand(const SweepOptions& options);
int calibrateCommand(const SweepOptions& options);
int designCommand(const SweepOptions& options);
int scaleCommand(const ScaleOptions& options);
int reportCommand(const ReportOptions& options);
int profileCommand(const ProfileOptions& options);
int renderCommand(const RenderOptions& options);

int completionCommand(const std::vector<CommandText>& tree, const ShellOptions& options);
int manCommand(const std::vector<CommandText>& commands, const ShellOptions& options);

}  // namespace vkdose
