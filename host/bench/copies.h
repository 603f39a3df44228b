#pragma once
// The same work in several processes at once. This measures how fast a processor is with many canisters, one for each
// core.

#include <functional>
#include <vector>

namespace vkdose::bench {

/// In a copy: waits until all copies have come here.
using Meet = std::function<void()>;

/// Forks `copies` processes, pins each to a processor of its own (round robin if there are fewer), and runs `work` in
/// each. `work` gives one figure for each of the `repeats` and must call `Meet` equally often in all copies. Sets
/// LP_NUM_THREADS=0 in the copies unless the caller's environment says otherwise, so that lavapipe keeps to this
/// processor. Returns the sums over the copies. Call it before the process has used a device, because drivers do not
/// survive a fork. Throws DeviceError if a copy fails; the copy has reported the cause on stderr.
std::vector<double> sumOfCopies(int copies, int repeats, const std::function<std::vector<double>(const Meet&)>& work);

}  // namespace vkdose::bench
