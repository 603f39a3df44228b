#pragma once
// Does a figure depend on the size of the spheres? The same powder in the same device, with spheres of several sizes.

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "host/study/gaussian_process.h"
#include "host/study/study.h"
#include "host/study/sweep_folder.h"

namespace vkdose {

inline constexpr const char* kScaleName = "scale.json";

struct ScaleAim {
    std::vector<double> factors{1, 1.5, 2, 3};  ///< sizes over those of the case, rising
    int seeds = 3;                              ///< of each size
    double within = 0.05;                       ///< relative difference that is none [-]
};

/// The study that varies the size of the spheres of a case: `particles.size.scale_up`, and bounds that are given in
/// sizes of spheres. Its contacts follow by contact.scaling = "stress", unless `overrides` ("key.path=value") state
/// another one. Throws CaseError if the case is at fault, or has a list of particles.
Study scaleStudy(const std::filesystem::path& file, const std::vector<std::string>& overrides, const ScaleAim& aim);

/// What became of the figures of a case as its spheres grew.
struct ScaleFinding {
    /// Judged against the smallest spheres.
    enum class Verdict {
        Holds,    ///< the mean is off by no more than is allowed, and the error of the difference is no larger either
        Differs,  ///< it is off by more, and by more than two such errors
        Open,     ///< the seeds do not tell
    };
    struct Size {
        double factor = 1;
        double diameter = 0;         ///< mean [m]
        std::size_t particles = 0;   ///< of the first member
        double timeStep = 0;         ///< [s]
        double work = 0;             ///< of the first member, by the closed forms [particle-steps]
        std::vector<double> widths;  ///< of each of `gaps`, in mean diameters
    };
    /// A width of the device that spheres have to fit into: "outlet".
    struct Gap {
        std::string name;
        double width = 0;  ///< [m]
    };
    struct Figure {
        std::string name;
        std::vector<Measured> at;       ///< of each size: mean over the seeds and its standard error; NaN without
        std::vector<Verdict> verdicts;  ///< of each size; that of the first is Holds
        std::size_t holds = 0;          ///< the largest size up to which it holds, as an index
    };
    double within = 0;
    std::vector<Gap> gaps;
    std::vector<Size> sizes;
    std::vector<Figure> figures;  ///< those that the smallest spheres have
};

/// The finding of a sweep of `study`, whose `members` have ended.
ScaleFinding scaleFinding(const Study& study, const ScaleAim& aim, const std::vector<Member>& members,
                          const SweepFolder& folder, std::vector<ScaleFinding::Gap> gaps);

/// The judgement of one size of which the seeds gave `values`, and the smallest spheres `reference`. `error` is the
/// standard error of the difference of the means.
ScaleFinding::Verdict judgeScale(double value, double reference, double error, double within);

/// "holds", "differs", "open".
const char* verdictText(ScaleFinding::Verdict verdict);

/// The content of scale.json; what is not known is null.
nlohmann::ordered_json scaleJson(const ScaleFinding& finding);

/// That of a folder; null without the file. Throws CaseError if it is damaged.
nlohmann::ordered_json readScale(const std::filesystem::path& folder);

}  // namespace vkdose
