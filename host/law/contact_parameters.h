#pragma once
// The laws of the normal force, and the parameters of a contact under them in SI. Symbols as in physics.md (Luding
// (2008), Granular Matter 10:235, and the paper's table).

#include <array>

#include "host/law/user_law.h"

namespace vkdose {

/// Normal force that limits friction: Luding -> max(0, f + k_c delta); Absolute -> |f_n|, damping included.
enum class CoulombLimit { Luding = 0, Absolute = 1 };

/// The law of the normal force. It also says how stiff sliding, rolling and torsion are, and how strongly all are
/// damped. The files of their names say what they are (host/law).
enum class NormalLaw {
#define LAW(number, Name, name, reaches, stiffens, keepsOverlap) Name = (number),
#include "shaders/shared/laws.h"
    User = 4,  ///< ContactLaw::user
};

/// Under Hertz-Mindlin, EEPA and JKR kt, kr and kTo are ratios to the stiffness 2 E* a of a contact of the radius a,
/// which is that of Hertz's line, gammaT, gammaR and gammaTo ratios to its damping [-]; k1, k2Max, kc, plasticityDepth
/// and gamma are not used. Under a user's law they are ratios to what its functions stiffness and damping answer. k1 is
/// then the largest stiffness of mean spheres, k2Max that of the smallest, gamma their largest damping and reach the
/// farthest, as a device told them (user_law_trial.h).
struct ContactParameters {
    double k1 = 0;               ///< plastic loading stiffness [N/m]
    double k2Max = 0;            ///< limit elastic stiffness, k2-hat [N/m]
    double kc = 0;               ///< adhesion stiffness [N/m]
    double plasticityDepth = 0;  ///< phi_f [-]
    double gamma = 0;            ///< normal viscosity [kg/s]
    double kt = 0;               ///< sliding stiffness [N/m]
    double gammaT = 0;           ///< sliding viscosity [kg/s]
    double mu = 0;               ///< sliding friction [-]
    double kr = 0;               ///< rolling stiffness [N/m]
    double gammaR = 0;           ///< rolling viscosity [kg/s]
    double muR = 0;              ///< rolling friction [-]
    double kTo = 0;              ///< torsion stiffness [N/m]
    double gammaTo = 0;          ///< torsion viscosity [kg/s]
    double muTo = 0;             ///< torsion friction [-]; 0 switches torsion off
    CoulombLimit coulombLimit = CoulombLimit::Luding;
    NormalLaw law = NormalLaw::Luding;
    double modulus = 0;          ///< Hertz-Mindlin, EEPA, JKR: E*, effective Young's modulus of the two bodies [Pa]
    double dampingShare = 0;     ///< Hertz-Mindlin, EEPA, JKR: beta, which gives the restitution (hertz.h) [-]
    double surfaceEnergy = 0;    ///< EEPA, JKR: delta gamma, of the two surfaces [J/m2]
    double plasticityRatio = 0;  ///< EEPA: lambda_p = 1 - k1/k2, below 1 [-]
    double constantPull = 0;     ///< EEPA: -f0, a pull that every contact has [N]
    double reach = 0;            ///< User: how far beyond touch any contact holds on, at most [m]
    double kMost = 0;            ///< User: the largest stiffness that the law's trial found [N/m]
    std::array<double, kMostLawParameters> own{};  ///< User: in the order of UserLaw::parameters
    double adhesionExponent = 1.5;                 ///< EEPA: chi, with which the pull fades as the contact opens [-]
};

}  // namespace vkdose
