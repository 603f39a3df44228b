#pragma once
// The verification suite: small physical cases with known answers, run on any backend. A family of cases is one file;
// a new case is a function there and a line in suite.cpp.

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "host/backend/backend.h"
#include "host/verify/finding.h"

namespace vkdose::verify {

/// Where a scene is played: a backend that it may load and advance freely, and a place for its findings.
class Stage {
  public:
    Stage(Backend& backend, std::string where) : backend_(&backend), where_(std::move(where)) {}

    Backend& backend() { return *backend_; }
    void check(const std::string& quantity, const std::string& unit, double expected, double got,
               const Tolerance& tolerance) {
        checks_.push_back({where_, quantity, unit, expected, got, tolerance, Kind::Known});
    }
    /// Adds a figure whose exact value nobody can know beforehand. It is counted apart.
    void plausible(const std::string& quantity, const std::string& unit, double expected, double got,
                   const Tolerance& tolerance) {
        checks_.push_back({where_, quantity, unit, expected, got, tolerance, Kind::Plausible});
    }
    const std::vector<Check>& checks() const { return checks_; }

  private:
    Backend* backend_;
    std::string where_;
    std::vector<Check> checks_;
};

struct Scene {
    std::string name;  ///< "family/case"
    std::string what;  ///< one line for people
    std::function<void(Stage&)> play;
};

/// Every case of the suite, in order.
std::vector<Scene> scenes();

/// The cases whose name contains `part`; all if it is empty.
std::vector<Scene> scenesNamed(const std::string& part);

/// Plays one case. A run that ends in a RunError counts as a check that fails, and so does a case that checks nothing.
/// DeviceError passes through.
std::vector<Check> play(const Scene& scene, Backend& backend);

}  // namespace vkdose::verify
