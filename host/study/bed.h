#pragma once
// The beds of a study. Members whose cases are equal in everything that acts before the first dose have one bed, which
// settles once.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "host/model/case.h"
#include "host/study/member.h"

namespace vkdose {

/// The case that settles the powder of `c` and doses none, as text. Cases with the same text have the same bed, to the
/// bit. Empty if the bed is not shared: the case settles nothing or doses nothing, its end time may come before the
/// first dose, or it keeps frames, which carry the number of their member.
std::string bedText(const Case& c);

/// A bed that several members have.
struct Bed {
    int number = 0;  ///< that of its first member
    std::string caseText;
    std::vector<int> members;  ///< their numbers, ascending
};

/// The beds that two of `members` or more have, in the order of their first members.
std::vector<Bed> bedsOf(const std::vector<Member>& members);

/// Particle-steps that the members need not make, because each bed settles once.
double workSaved(const std::vector<Bed>& beds, const std::vector<Member>& members);

/// "beds/0003" in the folder of a sweep.
std::filesystem::path bedFolder(const std::filesystem::path& sweep, const Bed& bed);

/// Whether the bed in `folder` has settled, as the run of this case.
bool isSettled(const std::filesystem::path& folder, const std::string& caseText);

/// Makes the folder of a member what it would be if the member had settled the bed itself and had then been
/// interrupted. The checkpoint comes last. Throws CheckpointError if the bed cannot be read, and OutputError.
void plantBed(const std::filesystem::path& bed, const std::filesystem::path& run, const Member& member);

}  // namespace vkdose
