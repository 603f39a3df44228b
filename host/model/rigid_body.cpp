#include "host/model/rigid_body.h"

namespace vkdose {

geometry::Pose RigidBody::pose(double time, double driveAngle) const {
    return course.pose(clock == Clock::Time ? time : driveAngle);
}

geometry::Moving RigidBody::moving(double time, double driveAngle, double driveRate) const {
    if (clock == Clock::Time) return course.moving(time);
    // The course gives the motion per radian of the drive.
    geometry::Moving moving = course.moving(driveAngle);
    moving.velocity *= driveRate;
    moving.spin *= driveRate;
    return moving;
}

}  // namespace vkdose
