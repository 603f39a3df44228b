#pragma once
// Runs the members of a sweep on all ranks of an MPI job. Rank 0 sweeps; every rank, it included, runs one member at a
// time as a process of its own, in a folder that all can see. Built with -DVKDOSE_MPI=ON.

#include <memory>

#include "host/app/backends.h"
#include "host/study/sweep.h"

namespace vkdose {

/// On rank 0, returns the runner; the job ends when the runner is destroyed. On the other ranks, serves rank 0 until
/// the job is over and then returns nothing. Throws UsageError if this vkdose was built without MPI.
std::unique_ptr<MemberRunner> makeMpiRunner(const BackendChoice& choice);

}  // namespace vkdose
