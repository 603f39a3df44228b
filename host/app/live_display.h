#pragma once
// The picture of a running simulation on a terminal. It is drawn again in place several times a second.

#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include "host/app/progress.h"
#include "host/backend/backend.h"
#include "host/terminal/pace.h"
#include "host/terminal/screen.h"

namespace vkdose {

class LiveDisplay : public RunDisplay {
  public:
    /// Reads particles from `backend` between two calls of the run, which does not change the run. `backend` must
    /// outlive this object. `before` holds the doses that a resumed run already has.
    LiveDisplay(const Case& c, const Derived& derived, const Backend& backend, std::vector<Dose> before,
                std::FILE* stream = stdout);

    /// Whether `stream` is a terminal that can be drawn on; if not, why.
    static bool possible(std::FILE* stream, std::string& why);

    void onProgress(const Progress& progress) override;
    void onSample(const Sample& sample) override;
    void onDose(const Dose& dose) override;

    /// Draws the last known state once more, without asking the backend, and leaves the cursor below the picture.
    void close() override;

  private:
    double now() const;
    void read(const Progress& progress);
    void draw();

    const Backend& backend_;
    terminal::Scene scene_;
    terminal::LiveState state_;
    Progress progress_;
    terminal::Style style_;
    std::FILE* stream_;
    terminal::Pace pace_;
    std::chrono::steady_clock::time_point start_;
    int columns_ = 0, rows_ = 0;  ///< of the terminal when it was drawn on
    std::size_t lines_ = 0;       ///< that stand above the cursor
};

}  // namespace vkdose
