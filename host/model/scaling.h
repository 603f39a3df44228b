#pragma once
// Spheres that stand for smaller grains: contact.scaling.

#include "host/model/case_reader.h"
#include "host/model/material.h"

namespace vkdose {

struct Case;

/// Makes parameters of grains those of spheres `s` times as large that bear the same stress at the same strain. In such
/// a contact lengths and times grow with s, forces with s^2 and masses with s^3, and speeds stay.
/// Not for NormalLaw::User: what its parameters mean is not known.
/// Source: Thakur, Ooi & Ahmadian, Powder Technology 293 (2016) 130: stiffness with the radius, adhesion with its
/// square.
void scaleStress(ContactParameters& p, double s);

/// The size of spheres over that of the grains that [contact] is of: 1, or by contact.scaling = "stress" the scale_up
/// of the powders. Tells where they differ, and where the law cannot be scaled. Call after the powders.
double readScaling(CaseReader& reader, Section& contact, NormalLaw law, const Case& c);

}  // namespace vkdose
