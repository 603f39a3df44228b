// The history that a run's own files tell: arches in the frames at the doses' ends.
#include "host/output/run_history.h"

#include "host/output/frame_writer.h"
#include "tests/analysis/beds.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"
#include "tests/support/near.h"

using namespace vkdose;
using namespace vkdose::test;

TEST_CASE("arches over time: of each complete dose the frame nearest to its end") {
    const Sandbox box;
    Case c;
    c.world.coil = paperCoil();
    c.canister = paperCanister();
    c.frames.interval = 0.5;
    Particles whole = layers(-10e-3, 40e-3), arched = whole;
    for (std::size_t i = 0; i < arched.size(); ++i)  // a tunnel between the planes at 0 and at 14 mm
        if (arched.position[i].y > 1e-3 && arched.position[i].y < 13e-3) arched.status[i] = Status::Dosed;
    {
        FrameWriter writer(box.path(), c, 0);
        // Doses end at 1.1, 2.1, 3.1 and 4.1 s; the last has no frame near.
        writer.put({10, 1.0, Phase::Rest, 1, 0, whole, {}});
        writer.put({15, 1.5, Phase::Rotate, 2, 0, arched, {}});
        writer.put({20, 2.0, Phase::Rest, 2, 0, arched, {}});
        writer.put({30, 3.0, Phase::Rest, 3, 0, arched, {}});
        (void)writer.store();
    }
    std::vector<Dose> doses(4);
    for (int i = 0; i < 4; ++i) {
        doses[std::size_t(i)].index = i + 1;
        doses[std::size_t(i)].startTime = 0.1 + i;
        doses[std::size_t(i)].endTime = 1.1 + i;
        doses[std::size_t(i)].complete = i != 2;
    }
    const std::vector<DoseArch> arches = archesAtDoseEnds(Frames(box.path()), c, doses);
    REQUIRE(arches.size() == 2);
    CHECK(arches[0].dose == 1);
    CHECK(arches[0].time == 1.0);
    CHECK_FALSE(arches[0].arch);
    CHECK(arches[1].dose == 2);
    CHECK(arches[1].time == 2.0);
    REQUIRE(arches[1].arch);
    CHECK(near(arches[1].arch->height, 12e-3, 2e-3, 1e-6));  // frames hold single precision
    c.world.coil.reset();
    CHECK(archesAtDoseEnds(Frames(box.path()), c, doses).empty());
    CHECK(archesAtDoseEnds(Frames(box / "none"), c, doses).empty());
}
