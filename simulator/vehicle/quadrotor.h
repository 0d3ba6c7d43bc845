// A quadrotor as a rigid body: four rotors with lag and limits, drag through moving air, flat ground.
#pragma once

#include <array>

#include "core/base/knobs.h"
#include "core/base/types.h"
#include "core/world/vehicle.h"

namespace tern {

using Rotors = std::array<double, 4>;

/// Two classes, with data of built and measured vehicles (quadrotor_spec).
enum class QuadrotorClass { Camera, Racer };

/// The section `quadrotor.body`. Rotors in B, at arm·(±1, ±1): front left, back left, back right, front right. Rotors
/// one and three turn one way, two and four the other way.
struct QuadrotorSpec {
  double mass_kg = 1.5;
  Vec3 inertia = Vec3(0.029, 0.029, 0.055);  ///< kg m², about B's axes
  double arm_m = 0.17;                       ///< a rotor's distance from B's x axis and from its y axis
  double thrust_to_weight = 2.0;             ///< of all four rotors together, > 1
  double least_thrust = 0.04;                ///< of a rotor, share of its largest: motors do not stop in flight
  double motor_lag_s = 0.025;                ///< thrust follows its command as a first-order lag
  double torque_per_thrust_m = 0.06;         ///< a rotor's reaction about its axis, per newton of thrust
  double drag_per_s = 0.37;                  ///< linear drag per mass across the rotor discs
  double drag_up_per_s = 0.1;                ///< the same along them
  double drag_per_m = 0.012;                 ///< quadratic drag per mass, all directions

  template <typename V>
  void visit(V& v) {
    v("mass_kg", mass_kg, Range{0.01, 100.0}, "mass of the whole vehicle, kg");
    v("inertia_x", inertia.x(), Range{1e-6, 100.0}, "moment of inertia about the forward axis, kg m²");
    v("inertia_y", inertia.y(), Range{1e-6, 100.0}, "moment of inertia about the axis to the left, kg m²");
    v("inertia_z", inertia.z(), Range{1e-6, 100.0}, "moment of inertia about the upward axis, kg m²");
    v("arm_m", arm_m, Range{0.01, 5.0}, "a rotor's distance from the forward axis, and from the axis to the left, m");
    v("thrust_to_weight", thrust_to_weight, Range{1.05, 20.0}, "largest thrust over weight");
    v("least_thrust", least_thrust, Range{0.0, 0.5}, "least thrust of a rotor, share of its largest");
    v("motor_lag_s", motor_lag_s, Range{0.005, 0.5}, "time constant of a rotor's thrust, s");
    v("torque_per_thrust_m", torque_per_thrust_m, Range{1e-4, 1.0}, "a rotor's reaction torque per thrust, m");
    v("drag_per_s", drag_per_s, Range{0.0, 10.0}, "linear drag per mass in the plane of the rotors, 1/s");
    v("drag_up_per_s", drag_up_per_s, Range{0.0, 10.0}, "linear drag per mass along the rotors' axes, 1/s");
    v("drag_per_m", drag_per_m, Range{0.0, 10.0}, "quadratic drag per mass, 1/m");
  }
  [[nodiscard]] double max_thrust() const { return thrust_to_weight * mass_kg * kGravity / 4.0; }  ///< of a rotor, N
};

/// Returns the data of a class.
///
/// Camera: 0.5 m from rotor to rotor, thrust/weight 2. It is 3DR's Iris of PX4's Gazebo models
/// (PX4-SITL_gazebo-classic, models/iris): mass, inertia, rotor positions and reaction torque, with the slower of its
/// two motor lags. drag_per_s follows from its rotor drag, 1.75e-4 N s²/m at hover speed.
///
/// Racer: 0.25 m, thrust/weight 4. It is the 5-inch quadrotor of Bauersfeld et al. (NeuroBEM, RSS 2021): mass, motor
/// lag, and inertia from the README of its data set. Its 33 N of thrust are limited to thrust/weight 4. Rotor positions
/// and reaction torque are those of the same frame in uzh-rpg's Agilicious. The linear drag is a typical value.
///
/// The quadratic drag of both (plates of 0.03 m² and 0.012 m²) is a typical value.
QuadrotorSpec quadrotor_spec(QuadrotorClass kind);

/// The state. B is forward, left, up.
struct QuadrotorState {
  Vec3 p = Vec3::Zero();                                  ///< W, m
  Vec3 v = Vec3::Zero();                                  ///< W, m/s
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();  ///< B to W, unit
  Vec3 w = Vec3::Zero();                                  ///< rates about B's axes, rad/s
  Rotors thrust{};                                        ///< N, each within its limits
  bool on_ground = false;
};

/// The state of hovering at p in still air: at rest, level, each rotor with a quarter of the weight.
QuadrotorState hovering(const QuadrotorSpec& spec, const Vec3& p, double yaw);
/// The state of standing at p, with the rotors at their least thrust.
QuadrotorState standing(const QuadrotorSpec& spec, const Vec3& p, double yaw);

/// Returns the smallest rotation that turns the direction of `from` into that of `to`; both are not zero. Of opposite
/// directions it is half a turn about one of the axes across. (The same as Eigen's FromTwoVectors, which takes 9 s to
/// compile.)
Eigen::Quaterniond smallest_rotation(const Vec3& from, const Vec3& to);

/// dv/dt in W, m/s²: gravity, thrust along B's z, drag against the air that moves with `wind` (W, m/s).
Vec3 acceleration(const QuadrotorSpec& spec, const QuadrotorState& state, const Vec3& wind);

/// Sum of the rotors' effects: thrust along B's z, N, and torque about B's axes, N m.
struct Wrench {
  double thrust = 0.0;
  Vec3 torque = Vec3::Zero();
};
Wrench wrench_of(const QuadrotorSpec& spec, const Rotors& thrust);

/// Returns the rotors' thrusts for a wrench, each within its limits. An unavailable wrench is reduced in the order of
/// autopilots: torque about B's z first, then thrust, then all torque by one factor. If the thrust is too small for the
/// torque, it is raised by at most half the difference to the hover thrust. So the vehicle does not climb.
Rotors allocate(const QuadrotorSpec& spec, const Wrench& wanted);

/// Makes one classical Runge–Kutta step over dt (s, at most a fifth of the motor's lag), with constant `command` (N per
/// rotor) and `wind`. The ground is the plane z = ground_z (−infinity: none). A body that reaches it from above stands
/// there, level, until thrust exceeds weight.
QuadrotorState step(const QuadrotorSpec& spec, const QuadrotorState& state, const Rotors& command, const Vec3& wind,
                    double ground_z, double dt);

}  // namespace tern
