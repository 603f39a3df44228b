#pragma once
// The columns of the files of fields. Which of them a file has depends on the field: see FieldFiles.

#include "host/core/columns.h"
#include "host/model/field.h"
#include "host/sim/field_watch.h"

namespace vkdose {

/// When a field was taken.
inline constexpr auto kFieldWhenColumns =
    columns(column<&FieldSample::time>("time_s", "s", "Simulated time; of an average the end of its time."),
            column<&FieldSample::phase>(
                "phase", "", "What the schedule asks for in the time before it: settle, rotate, reverse or rest."),
            column<&FieldSample::dose>("dose", "1", "Number of the dose, from 1; 0 while settling."));

/// A point of the grid and the values there.
struct FieldRow {
    Vec3 place{0};  ///< [m]
    FieldPoint point;
    double solid = 0;  ///< density of the particles [kg/m3]

    double volumeFraction() const { return point.density / solid; }
};

inline constexpr auto kPlaceColumns = columns(
    column<&FieldRow::place, 0>("x_m", "m", "Place of the point along x; only if the field is resolved along x."),
    column<&FieldRow::place, 1>("y_m", "m", "Place of the point along y; only if the field is resolved along y."),
    column<&FieldRow::place, 2>("z_m", "m", "Place of the point along z; only if the field is resolved along z."));

inline constexpr auto kQuantityColumns = columns(
    column<&FieldRow::point, &FieldPoint::density>("density_kg_m3", "kg/m3", "Mass of the powder per volume."),
    column<&FieldRow::volumeFraction>("volume_fraction", "1", "Share of the volume that the particles fill."),
    column<&FieldRow::point, &FieldPoint::momentum, 0>("momentum_x_kg_m2_s", "kg/m2/s", "Momentum along x per volume."),
    column<&FieldRow::point, &FieldPoint::momentum, 1>("momentum_y_kg_m2_s", "kg/m2/s", "Momentum along y per volume."),
    column<&FieldRow::point, &FieldPoint::momentum, 2>("momentum_z_kg_m2_s", "kg/m2/s", "Momentum along z per volume."),
    column<&FieldRow::point, &FieldPoint::velocity, 0>("velocity_x_m_s", "m/s",
                                                       "Mean velocity of the mass along x; nan where there is none."),
    column<&FieldRow::point, &FieldPoint::velocity, 1>("velocity_y_m_s", "m/s", "The same along y."),
    column<&FieldRow::point, &FieldPoint::velocity, 2>("velocity_z_m_s", "m/s", "The same along z."));

/// Columns of a field with `stress`.
inline constexpr auto kStressColumns =
    columns(column<&FieldRow::point, &FieldPoint::coordination>("coordination", "1",
                                                                "Mean number of neighbours that a particle touches."),
            column<&FieldRow::point, &FieldPoint::temperature>(
                "granular_temperature_m2_s2", "m2/s2", "A third of the mean square of the velocity about its mean."),
            column<&FieldRow::point, &FieldPoint::kineticStress, 0>(
                "kinetic_stress_xx_Pa", "Pa", "Stress by the velocities about their mean, xx; pressure is positive."),
            column<&FieldRow::point, &FieldPoint::kineticStress, 1>("kinetic_stress_yy_Pa", "Pa", "The same, yy."),
            column<&FieldRow::point, &FieldPoint::kineticStress, 2>("kinetic_stress_zz_Pa", "Pa", "The same, zz."),
            column<&FieldRow::point, &FieldPoint::kineticStress, 3>("kinetic_stress_yz_Pa", "Pa", "The same, yz."),
            column<&FieldRow::point, &FieldPoint::kineticStress, 4>("kinetic_stress_zx_Pa", "Pa", "The same, zx."),
            column<&FieldRow::point, &FieldPoint::kineticStress, 5>("kinetic_stress_xy_Pa", "Pa", "The same, xy."),
            column<&FieldRow::point, &FieldPoint::contactStress, 0, 0>(
                "contact_stress_xx_Pa", "Pa",
                "Stress by the contact forces, force along x, branch along x; pressure is "
                "positive."),
            column<&FieldRow::point, &FieldPoint::contactStress, 0, 1>("contact_stress_xy_Pa", "Pa",
                                                                       "The same, force along x, branch along y."),
            column<&FieldRow::point, &FieldPoint::contactStress, 0, 2>("contact_stress_xz_Pa", "Pa",
                                                                       "The same, force along x, branch along z."),
            column<&FieldRow::point, &FieldPoint::contactStress, 1, 0>("contact_stress_yx_Pa", "Pa",
                                                                       "The same, force along y, branch along x."),
            column<&FieldRow::point, &FieldPoint::contactStress, 1, 1>("contact_stress_yy_Pa", "Pa",
                                                                       "The same, force along y, branch along y."),
            column<&FieldRow::point, &FieldPoint::contactStress, 1, 2>("contact_stress_yz_Pa", "Pa",
                                                                       "The same, force along y, branch along z."),
            column<&FieldRow::point, &FieldPoint::contactStress, 2, 0>("contact_stress_zx_Pa", "Pa",
                                                                       "The same, force along z, branch along x."),
            column<&FieldRow::point, &FieldPoint::contactStress, 2, 1>("contact_stress_zy_Pa", "Pa",
                                                                       "The same, force along z, branch along y."),
            column<&FieldRow::point, &FieldPoint::contactStress, 2, 2>("contact_stress_zz_Pa", "Pa",
                                                                       "The same, force along z, branch along z."));

}  // namespace vkdose
