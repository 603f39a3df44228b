#include "host/app/mpi/mpi_runner.h"

namespace vkdose {

std::unique_ptr<MemberRunner> makeMpiRunner(const BackendChoice&) {
    throw UsageError("--mpi: this vkdose was built without MPI; configure it with -DVKDOSE_MPI=ON");
}

}  // namespace vkdose
