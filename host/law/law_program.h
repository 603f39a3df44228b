#pragma once
// A user's law that runs in double precision, from the same text as on a device.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "host/law/law_tree.h"
#include "host/law/user_law.h"

namespace vkdose {

/// What a law is told of a contact (cases/laws/README.md).
struct LawContact {
    double overlap = 0;  ///< [m]
    double speed = 0;    ///< of approach [m/s]
    double radius = 0;   ///< reduced [m]
    double mass = 0;     ///< reduced [kg]
};

/// What it answers.
struct LawAnswer {
    double force = 0, stiffness = 0, damping = 0, pull = 0, energy = 0;
    LawProperties flows{};  ///< what the first side gains by the contact, and the other loses [unit/s]
};

/// The properties of the two sides of a contact.
struct LawSides {
    LawProperties i{}, j{};
};

class LawProgram {
  public:
    using Parameters = std::array<double, kMostLawParameters>;
    using Memory = std::array<double, kMostLawMemories>;

    /// Throws LawRefused where the text is not in the language.
    explicit LawProgram(const UserLaw& law);

    /// `force` changes the memory; the other functions see it as `force` left it.
    LawAnswer answer(const Parameters& parameters, const LawContact& contact, Memory& memory,
                     const LawSides& sides = {});
    /// How far beyond touch a contact of this reduced radius holds on [m].
    double reach(const Parameters& parameters, double radius);

    /// Expressions that were evaluated so far.
    std::uint64_t work() const { return work_; }

  private:
    enum class Flow : std::uint8_t { On, Break, Continue, Return };

    void begin(const Parameters& parameters, const Memory& memory, const LawSides& sides);
    double call(const LawFunction* function, const LawContact& contact);
    LawValue call(const LawFunction& function, std::span<const LawValue> arguments);
    LawValue value(const LawExpression& e);
    LawValue assigned(const LawExpression& e, const LawValue& to);
    LawValue stepped(const LawExpression& e);
    std::vector<LawValue> operandsOf(const LawExpression& e);
    Flow run(const LawStatement& s);
    Flow runLoop(const LawStatement& s);

    LawTree tree_;
    const LawFunction *force_, *stiffness_, *damping_, *pull_, *energy_, *reach_;
    std::vector<const LawFunction*> flows_;  ///< of each property; null where it does not flow
    std::vector<LawValue> variables_;
    LawValue returned_;
    std::uint64_t work_ = 0;
};

}  // namespace vkdose
