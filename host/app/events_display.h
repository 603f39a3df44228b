#pragma once
// A run as JSON on stdout, a line for each event, for other programs.

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "host/advice/advice.h"
#include "host/app/exit_code.h"
#include "host/app/orders.h"
#include "host/app/progress.h"

namespace vkdose {

/// Writes one JSON object on a line for each event; its member "event" says which. Numbers that do not exist are null.
///
///     run      case, particles, filled_kg, output, backend, version, from_s (simulated time of the checkpoint, or 0)
///     warning  name, key, value, text, cure, accepted
///     phase    phase, dose, time_s, step, expected_steps (of the whole run; 0: not known)
///     sample   the columns of timeseries.csv; "bodies", "regions" and "powders": the columns of each, by their names
///     settled  time_s, at_rest, speed_m_s, fall_speed_m_s, spilled_kg
///     dose     the columns of doses.csv; "bodies", "regions" and "powders" as above
///     order    order ("speed" or "stop"), time_s, speed_rpm or null: one that the drive obeys
///     refused  order (the line), why
///     end      stop_reason, stop_sentence, code (exit code of the program), error or null, output
///
/// If nobody reads any longer, the run is interrupted as by Ctrl-C and can be resumed.
class EventsDisplay : public RunDisplay {
  public:
    /// With `orders` the run obeys them.
    explicit EventsDisplay(const Case& c, std::unique_ptr<Orders> orders = nullptr, std::FILE* stream = stdout);

    void begin(const Insertion& filled, const std::filesystem::path& output, const std::string& backend, double from);
    void warn(const Warning& warning);
    void onProgress(const Progress& progress) override;
    void onSample(const Sample& sample) override;
    void onSettled(const Settling& settling, const Case& c) override;
    void onDose(const Dose& dose) override;
    void onRefill(const AddedPowder& powder) override;
    DriveOrder order() override;
    void onOrder(const GivenOrder& given) override;
    bool wantsRefill(std::size_t refill) override;
    void end(const RunResult& result, ExitCode code, const std::string& error, const std::filesystem::path& output);
    void close() override {}

  private:
    void say(const nlohmann::ordered_json& event);

    void hearOrders();

    const Case& case_;
    std::unique_ptr<Orders> orders_;
    std::FILE* stream_;
    Phase phase_ = Phase::Settle;
    int dose_ = -1;  ///< of the last phase told; -1: none
    bool heard_ = true;
};

}  // namespace vkdose
