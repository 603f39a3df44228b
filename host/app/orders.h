#pragma once
// Orders that another program, or a person, gives a run while it goes on: lines on its standard input.

#include <optional>
#include <string>
#include <vector>

#include "host/model/case.h"
#include "host/sim/dose.h"
#include "host/sim/sample.h"

namespace vkdose {

/// A line is one of
///
///     speed 90      from now on the drive turns at 90 rpm, to the end of this dose
///     dose 3.5      it stops as soon as 3.5 g are out in this dose
///     stop          it stops now
///     refill NAME   this refill of the case is added
///
/// `speed` and `dose` wait if the drive does not turn now, and are for the next dose then.
class Orders {
  public:
    /// Reads a file descriptor, and never waits for it.
    Orders(const Case& c, int file);

    struct Refused {
        std::string order, why;
    };
    /// Takes the lines that have come. Returns those that cannot be obeyed.
    std::vector<Refused> hear();

    /// To be told of each sample.
    void look(const Sample& sample);
    /// What the drive is to do, at a sample at which it takes orders.
    DriveOrder take();
    bool wantsRefill(std::size_t refill) const { return refills_[refill]; }

  private:
    std::optional<std::string> obey(const std::string& line);
    std::optional<std::string> takeRefill(const std::string& name);

    const Case& case_;
    int file_;
    bool open_ = true;
    std::string text_;  ///< of a line that is not whole yet
    bool turns_ = false;
    int dose_ = 0;
    double out_ = 0, before_ = 0;  ///< dosed by now, and when this dose began [kg]
    bool stop_ = false;
    std::optional<double> speed_;   ///< [rad/s]
    std::optional<double> target_;  ///< of this dose, or of the next [kg]
    int targetDose_ = 0;            ///< the one it is for; 0: the next that turns
    std::vector<bool> refills_;
};

}  // namespace vkdose
