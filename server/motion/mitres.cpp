#include "server/motion/mitres.h"

#include "server/motion/polynomial.h"

namespace kcs::motion {

void pass_mitres(const Phase& phase, std::span<const Piece> pieces, std::vector<double>& times) {
  times.assign(pieces.size() - 1, phase.duration);
  const Vector end = phase.at(phase.duration).position;
  double time = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Vector normal = pieces[i].line.direction() + pieces[i + 1].line.direction();
    const Vector& joint = pieces[i].line.to();
    if (!((end - joint).dot(normal) > 0)) return;
    const std::array<double, 4> beyond{(phase.start.position - joint).dot(normal), phase.start.velocity.dot(normal),
                                       phase.start.acceleration.dot(normal) / 2, phase.jerk.dot(normal) / 6};
    const double now = beyond[0] + time * (beyond[1] + time * (beyond[2] + time * beyond[3]));
    if (now < 0) time = root_between(beyond, time, phase.duration);
    times[i] = time;
  }
}

}  // namespace kcs::motion
