#pragma once

namespace vkdose {

/// The program returns one of these to the shell. A sweep reads the codes of the runs that it starts.
enum ExitCode {
    /// Everything was done, and what was compared agrees.
    kOk = 0,
    /// Everything was done, but not all is well: compare and verify found a quantity outside its tolerance, or a member
    /// of a sweep failed.
    kDisagree = 1,
    /// The case, the study, a file to read or the command line is wrong. Nothing was written.
    kBadInput = 2,
    /// The run could not go on: a particle was lost, a number was none, an overlap was too deep. What was computed is
    /// kept.
    kRunError = 3,
    /// There is no usable device, or it failed. What was computed is kept.
    kDeviceError = 4,
    /// A result could not be written, for example because the disk is full.
    kOutputError = 5,
    /// The time that --for gave a sweep is over. What was computed is kept, and the same command goes on.
    kTimeIsUp = 6,
    /// Ctrl-C or another signal asked it to stop. What was computed is kept, and the run can go on. A shell reports the
    /// same for a program that SIGINT ended: 128 + 2.
    kInterrupted = 130,
};

}  // namespace vkdose
