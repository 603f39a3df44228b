#pragma once
// How fast the machine steps, for estimates of run times.

#include <string>

#include "host/app/backends.h"
#include "host/model/case.h"

namespace vkdose {

/// Assumed where no speed is measured [particle-steps/s]: about that of two cores of a server with a CPU driver and a
/// settled bed.
inline constexpr double kAssumedSpeed = 6e6;

struct Speed {
    double rate = 0;  ///< [particle-steps/s]
    bool measured = false;
    std::string told;           ///< on which backend it was measured, or why it was not; empty: nobody asked
    std::size_t particles = 0;  ///< with which it was measured
};

/// The speed of a backend with the fresh filling of a case, measured for about a second, or an assumed one if `assume`
/// or if the backend cannot be had or run.
Speed speedOf(const Case& c, const Insertion& filled, const BackendChoice& choice, bool assume);

/// "at 8.31 M particle-steps/s, measured on reference"
std::string speedText(const Speed& speed);

/// What a run takes, for people, in lines with their labels: its steps and, by this speed, its time.
std::string workText(const Derived& derived);
std::string runTimeText(const Derived& derived, const Speed& speed);

/// A line that says what a measured speed does not know, behind so many spaces; empty if it is assumed.
std::string caveatText(const Speed& speed, int indent);

}  // namespace vkdose
