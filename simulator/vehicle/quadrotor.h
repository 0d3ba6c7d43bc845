// A quadrotor as a rigid body: four rotors with lag and limits, drag through moving air, flat ground.
#pragma once

#include <array>

#include "core/base/knobs.h"
#include "core/base/types.h"
#include "core/world/vehicle.h"

namespace tern {

using Rotors = std::array<double, 4>;

/// Two classes whose figures come from what was built and measured (quadrotor_spec).
enum class QuadrotorClass { Camera, Racer };

/// The body's parameters. Rotors: front left, back left, back right, front right, at arm·(±1, ±1) in B; the first and
/// third turn one way, the others the other way.
struct QuadrotorSpec {
  double mass_kg = 1.5;
  Vec3 inertia = Vec3(0.029, 0.029, 0.055);  ///< kg m², about B's axes
  double arm_m = 0.17;                       ///< a rotor's distance from B's x axis and from its y axis
  double thrust_to_weight = 2.0;             ///< of all four rotors together, > 1
  double least_thrust = 0.04;                ///< of a rotor, as a share of its largest: motors do not stop in flight
  double motor_lag_s = 0.025;                ///< thrust follows its command as a first-order lag
  double torque_per_thrust_m = 0.06;         ///< a rotor's reaction about its axis, per newton of thrust
  double drag_per_s = 0.37;                  ///< linear drag per mass across the rotor discs
  double drag_up_per_s = 0.1;                ///< the same along them
  double drag_per_m = 0.012;                 ///< quadratic drag per mass, all directions

  template <typename V>
  void visit(V& v) {
    v("mass_kg", mass_kg, Range{0.01, 100.0}, "of the whole vehicle, kg");
    v("inertia_x", inertia.x(), Range{1e-6, 100.0}, "about the forward axis, kg m²");
    v("inertia_y", inertia.y(), Range{1e-6, 100.0}, "about the axis to the left, kg m²");
    v("inertia_z", inertia.z(), Range{1e-6, 100.0}, "about the upward axis, kg m²");
    v("arm_m", arm_m, Range{0.01, 5.0}, "a rotor's distance from the forward axis, and from the axis to the left, m");
    v("thrust_to_weight", thrust_to_weight, Range{1.05, 20.0}, "largest thrust over weight");
    v("least_thrust", least_thrust, Range{0.0, 0.5}, "of a rotor, share of its largest");
    v("motor_lag_s", motor_lag_s, Range{0.005, 0.5}, "time constant of a rotor's thrust, s");
    v("torque_per_thrust_m", torque_per_thrust_m, Range{1e-4, 1.0}, "a rotor's reaction torque per thrust, m");
    v("drag_per_s", drag_per_s, Range{0.0, 10.0}, "linear drag per mass across the rotor discs, 1/s");
    v("drag_up_per_s", drag_up_per_s, Range{0.0, 10.0}, "linear drag per mass along the rotors' axes, 1/s");
    v("drag_per_m", drag_per_m, Range{0.0, 10.0}, "quadratic drag per mass, 1/m");
  }
  [[nodiscard]] double max_thrust() const { return thrust_to_weight * mass_kg * kGravity / 4.0; }  ///< of a rotor, N
};

/// Camera: 0.5 m from rotor to rotor, thrust/weight 2: 3DR's Iris as PX4's Gazebo models it, with the slower of its two
/// motor lags. From there (PX4-SITL_gazebo-classic, models/iris) come mass, inertia, rotors' places and reaction. Its
/// rotor drag, 1.75e-4 N s²/m at hover speed, gives drag_per_s. Racer: 0.25 m, thrust/weight 4: the 5-inch quadrotor of
/// Bauersfeld et al. (NeuroBEM, RSS 2021: mass, motor lag, 33 N of thrust, here held to 4; inertia by its data set's
/// README), rotors' places and reaction as in the models of the same frame in uzh-rpg's Agilicious. Its linear drag,
/// and both quadratic ones (plates of 0.03 m² and of 0.012 m²), are typical values, not measured ones.
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

/// Hovering at p in still air: at rest, level, each rotor a quarter of the weight.
QuadrotorState hovering(const QuadrotorSpec& spec, const Vec3& p, double yaw);
/// Standing at p, rotors at their least thrust.
QuadrotorState standing(const QuadrotorSpec& spec, const Vec3& p, double yaw);

/// dv/dt in W, m/s²: gravity, thrust along B's z, drag against the air that moves with `wind` (W, m/s).
Vec3 acceleration(const QuadrotorSpec& spec, const QuadrotorState& state, const Vec3& wind);

/// What the rotors do together: thrust along B's z, N, and torque about B's axes, N m.
struct Wrench {
  double thrust = 0.0;
  Vec3 torque = Vec3::Zero();
};
Wrench wrench_of(const QuadrotorSpec& spec, const Rotors& thrust);

/// The rotors' thrusts for a wrench, each within its limits. What cannot be had is given up in the order of autopilots:
/// torque about B's z first, then thrust, then all torque by one factor. Where thrust is too little for the torque, it
/// is raised, but at most half the way to hovering: so much that it does not climb.
Rotors allocate(const QuadrotorSpec& spec, const Wrench& wanted);

/// One step of classical Runge–Kutta over dt (s, at most a fifth of the motor's lag), `command` (N per rotor) and
/// `wind` held. The ground is the plane z = ground_z: whoever comes to it from above stands there, level, and leaves it
/// when thrust exceeds weight. −infinity: there is none.
QuadrotorState step(const QuadrotorSpec& spec, const QuadrotorState& state, const Rotors& command, const Vec3& wind,
                    double ground_z, double dt);

}  // namespace tern
