// The ranges in which kcs computes safely; what lies outside is refused. Each is far beyond any machine.
#pragma once

namespace kcs::planning::range {

inline constexpr double kCoordinate = 1e7;                                // mm, either sign
inline constexpr double kMinFeed = 1e-6, kMaxFeed = 1e6;                  // mm/s
inline constexpr double kMaxTolerance = 1e3;                              // mm
inline constexpr double kMaxDwell = 1e6;                                  // s
inline constexpr double kMaxSpindleSpeed = 1e6;                           // 1/min
inline constexpr double kMinVelocity = 1e-3, kMaxVelocity = 1e6;          // mm/s
inline constexpr double kMinAcceleration = 1e-3, kMaxAcceleration = 1e9;  // mm/s²
inline constexpr double kMinJerk = 1e-3, kMaxJerk = 1e12;                 // mm/s³

}  // namespace kcs::planning::range
