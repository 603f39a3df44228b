#pragma once
// A backend with a gate before it: whoever advances it has to pass. All other calls go straight through.

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "host/backend/backend.h"

namespace vkdose {

class Gate final : public Backend {
  public:
    /// Calls `pass` before each `advance`. An exception that it throws is that of `advance`.
    Gate(Backend& behind, std::function<void()> pass) : behind_(behind), pass_(std::move(pass)) {}

    std::uint64_t steps() const { return steps_; }  ///< made through this gate

    void load(const World& world, const ContactLaw& law, const Particles& particles) override {
        behind_.load(world, law, particles);
    }
    void setLaw(const ContactLaw& law) override { behind_.setLaw(law); }
    void setClocks(const std::vector<BodyClock>& clocks) override { behind_.setClocks(clocks); }
    Sensors advance(std::uint32_t steps, double coilRate) override {
        pass_();
        Sensors sensors = behind_.advance(steps, coilRate);
        steps_ += steps;
        return sensors;
    }
    Record snapshot() const override { return behind_.snapshot(); }
    void restore(const Record& record) override { behind_.restore(record); }
    Particles particles() const override { return behind_.particles(); }
    std::vector<Contact> contacts() const override { return behind_.contacts(); }
    FieldPoints fields(const FieldRequest& request) override { return behind_.fields(request); }
    double coilAngle() const override { return behind_.coilAngle(); }
    std::string description() const override { return behind_.description(); }

  private:
    Backend& behind_;
    std::function<void()> pass_;
    std::uint64_t steps_ = 0;
};

}  // namespace vkdose
