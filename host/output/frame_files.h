#pragma once
// The contents of a frame's files: VTKHDF files that ParaView shows and that give the frame back, bit for bit.
//
//   particles: a vertex for each particle, dosed ones included, in the order of their numbers
//   contacts:  a line for each contact, from the particle's centre to the other's, or to the point of the wall

#include <cstdint>
#include <string>
#include <vector>

#include "host/model/world.h"
#include "host/output/vtkhdf.h"
#include "host/sim/frame.h"

namespace vkdose {

/// `member` is the number that distinguishes the canisters of a study.
std::string particlesFile(const Frame& frame, const World& world, std::uint32_t member);
std::string contactsFile(const Frame& frame, const World& world);

/// The data of the two files, for readers in the same process.
vtkhdf::Grid particlesGrid(const Frame& frame, const World& world, std::uint32_t member);
vtkhdf::Grid contactsGrid(const Frame& frame, const World& world);

/// The time of a frame and its place in the schedule, as the field data of its files.
std::vector<vtkhdf::Array> fieldsOf(const Frame& frame);

/// Read the contents of the two files back into `frame`: step, time, phase, dose and angle too. Throw hdf5::Error if
/// the files hold something else.
void readParticlesFile(std::string bytes, Frame& frame, const std::vector<std::string>& properties = {});
void readContactsFile(std::string bytes, Frame& frame);

}  // namespace vkdose
