#pragma once
// Spheres that stand for smaller grains: contact.scaling.

#include "host/model/case_reader.h"
#include "host/model/material.h"

namespace vkdose {

struct Case;

/// The size of spheres over that of the grains that [contact] is of: 1, or by contact.scaling = "stress" the scale_up
/// of the powders. Tells where they differ, and where the law cannot be scaled.
double readScaling(CaseReader& reader, Section& contact, NormalLaw law, const Case& c);

}  // namespace vkdose
