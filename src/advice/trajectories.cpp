#include "advice/trajectories.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

#include "base/math/time_integral.hpp"
#include "setup/changes_in_time.hpp"
#include "topology/bounding_box.hpp"

namespace strut {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Restricts the interval [from, to] to the times at which distance + speed t ≤ 0.
void restrict_to_overlap(double distance, double speed, double& from, double& to) {
  if (speed == 0) {
    if (distance > 0) to = -infinity;
  } else if (speed < 0) {
    from = std::max(from, -distance / speed);
  } else {
    to = std::min(to, -distance / speed);
  }
}

// The same along one axis, for a block below another one. Cells that are no boxes are known by their moments, so that
// those that touch may seem to overlap: points then count, unless these come a tenth of their distance nearer.
void restrict_to_overlap(const Trajectory& low, const Trajectory& high, int axis, double duration, double& from,
                         double& to) {
  constexpr double much = 0.1;
  const double apart = high.cells.min()[axis] - low.cells.max()[axis];
  const double of_points = high.places.min()[axis] - low.places.max()[axis];
  const double speed = high.velocities.min()[axis] - low.velocities.max()[axis];
  const bool touch = of_points > 0 && apart < 1e-6 * of_points, stay = -speed * duration < much * of_points;
  restrict_to_overlap(!touch ? apart : stay ? of_points : 0, speed, from, to);
}

// True if displacements along an axis are too short for the cells of a block below another one to get there.
bool stay_apart(const Trajectory& low, const Trajectory& high, int axis) {
  return low.cells.max()[axis] + low.displacements.max()[axis] <
         high.cells.min()[axis] + high.displacements.min()[axis];
}

// Collective. The range of each point's displacements from its place at the start.
std::vector<Eigen::AlignedBox3d> displacements_of_points(const Scene& scene, const std::vector<Vector>& velocities,
                                                         double start, double duration) {
  const Body& body = scene.body;
  std::vector<Eigen::AlignedBox3d> all(body.owned(), Eigen::AlignedBox3d(Vector::Zero()));
  for (int i = 0; i < body.owned(); ++i) all[i].extend(Vector(duration * velocities[i]));
  std::vector<double> changes;
  bool any = false;
  scene.conditions.visit([&](const PrescribedMotion& one) {
    any = true;
    std::ranges::copy(changes_of(one.value, where(one.points, body), start, start + duration),
                      std::back_inserter(changes));
    for (const int i : one.points) {
      for (const int c : one.components) all[i].min()[c] = all[i].max()[c] = 0;
    }
  });
  if (!any) return all;
  std::vector<Vector> displacements(body.owned());
  for (int i = 0; i < body.owned(); ++i) displacements[i] = body.displacement(i);
  const std::vector<double> times = sample_times(std::move(changes), start, duration);
  for (std::size_t k = 1; k < times.size(); ++k) {
    move_on(scene.conditions, body.domain, times[k], times[k] - times[k - 1], displacements);
    scene.conditions.visit([&](const PrescribedMotion& one) {
      for (const int i : one.points) {
        const Vector moved_by = displacements[i] - body.displacement(i);
        for (const int c : one.components) {
          all[i].min()[c] = std::min(all[i].min()[c], moved_by[c]),
          all[i].max()[c] = std::max(all[i].max()[c], moved_by[c]);
        }
      }
    });
  }
  return all;
}

// Restricts it to the times at which two blocks overlap along all axes.
void restrict_to_overlap(const Trajectory& a, const Trajectory& b, double duration, double& from, double& to) {
  for (int c = 0; c < 3; ++c) {
    if (stay_apart(a, b, c) || stay_apart(b, a, c)) to = -infinity;
    restrict_to_overlap(b, a, c, duration, from, to);
    restrict_to_overlap(a, b, c, duration, from, to);
  }
}

void extend(Trajectory& trajectory, const Body& body, int i, const Tensor& axes) {
  const Domain& domain = body.domain;
  const Vector place = axes.transpose() * body.current(i);
  trajectory.places.extend(place);
  for (int c = 0; c < 3; ++c) {
    const auto reach = [&](const Vector& to) { return reach_of_cell(domain.cloud, domain.volume(i), i, to); };
    trajectory.cells.extend(place + reach(axes.col(c)) * Vector::Unit(c));
    trajectory.cells.extend(place - reach(-axes.col(c)) * Vector::Unit(c));
  }
}

// Collective. A block's trajectory along other axes.
Trajectory along(const Tensor& axes, const Body& body, int block, const Trajectory& in_space) {
  Trajectory seen;
  for (const int i : body.blocks[block].points) extend(seen, body, i, axes);
  for (Eigen::AlignedBox3d* box : {&seen.places, &seen.cells}) *box = common_box(*box, body.domain.communicator);
  for (int k = 0; k < 8; ++k) {
    const auto corner = static_cast<Eigen::AlignedBox3d::CornerType>(k);
    seen.velocities.extend(axes.transpose() * in_space.velocities.corner(corner));
    seen.displacements.extend(axes.transpose() * in_space.displacements.corner(corner));
  }
  return seen;
}

struct Frame {
  Vector center = Vector::Zero();
  Tensor axes = Tensor::Identity();
};

// Collective. The center and the principal axes of a block's points.
Frame frame_of(const Body& body, int block, const Trajectory& in_space) {
  const Vector middle = in_space.places.center();
  double sums[13] = {};
  Eigen::Map<Vector> first(sums);
  Eigen::Map<Tensor> second(sums + 3);
  for (const int i : body.blocks[block].points) {
    const Vector r = body.current(i) - middle;
    first += r, second += r * r.transpose(), ++sums[12];
  }
  body.domain.communicator.sum(sums);
  const Vector mean = first / sums[12];
  const Tensor moments = second / sums[12] - mean * mean.transpose();
  return {middle + mean, Eigen::SelfAdjointEigenSolver<Tensor>(moments).eigenvectors()};
}

// Axes of which the first has this direction.
Tensor axes_along(const Vector& direction) {
  Tensor axes;
  axes.col(0) = direction.normalized(), axes.col(1) = direction.unitOrthogonal();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

}  // namespace

void move_on(const Conditions& conditions, const Domain& domain, double time, double step,
             std::vector<Vector>& displacements) {
  conditions.visit([&](const PrescribedMotion& one) {
    for (const int i : one.points) {
      const Vector X = domain.reference(i);
      const double value = one.value.evaluate(X, one.is_velocity ? time - 0.5 * step : time);
      for (const int c : one.components)
        displacements[i][c] = one.is_velocity ? displacements[i][c] + step * value : value;
    }
  });
}

std::vector<double> sample_times(std::vector<double> changes, double start, double duration) {
  constexpr int samples = 64;  // evenly, and as many changes at most
  std::ranges::sort(changes);
  std::vector<double> times = thinned(changes, samples);
  std::ranges::copy(uneven_times(start, start + duration, samples), std::back_inserter(times));
  std::ranges::sort(times);
  return times;
}

Trajectory shifted(Trajectory trajectory, const Vector& by) {
  trajectory.places.translate(by), trajectory.cells.translate(by);
  return trajectory;
}

std::vector<Trajectory> trajectories(const Scene& scene, double start, double duration) {
  const Domain& domain = scene.body.domain;
  std::vector<Trajectory> all(domain.cloud.block_names.size());
  const std::vector<Vector> velocities =
      predicted_velocities(scene.conditions, start, first_moment * duration, scene.body);
  const std::vector<Eigen::AlignedBox3d> displacements = displacements_of_points(scene, velocities, start, duration);
  for (int i = 0; i < domain.owned; ++i) {
    Trajectory& trajectory = all[domain.cloud.blocks[i]];
    trajectory.velocities.extend(velocities[i]);
    trajectory.displacements.extend(displacements[i]);
    extend(trajectory, scene.body, i, Tensor::Identity());
  }
  for (Trajectory& trajectory : all) {
    for (Eigen::AlignedBox3d* box :
         {&trajectory.places, &trajectory.cells, &trajectory.velocities, &trajectory.displacements})
      *box = common_box(*box, domain.communicator);
  }
  return all;
}

std::optional<double> meeting_time(const Trajectory& a, const Trajectory& b, double duration) {
  if (a.places.isEmpty() || b.places.isEmpty()) return std::nullopt;
  double from = 0, to = duration;
  restrict_to_overlap(a, b, duration, from, to);
  return from <= to ? std::optional(from) : std::nullopt;
}

std::vector<View> views_of(const Body& body, const std::vector<Trajectory>& all, int a, int b) {
  const Frame of_a = frame_of(body, a, all[a]), of_b = frame_of(body, b, all[b]);
  std::vector<View> views = {{Tensor::Identity(), all[a], all[b]}};
  std::vector<Tensor> others = {of_a.axes, of_b.axes};
  const Vector between = of_b.center - of_a.center;
  if (!between.isZero()) others.push_back(axes_along(between));
  for (const Tensor& axes : others) views.push_back({axes, along(axes, body, a, all[a]), along(axes, body, b, all[b])});
  return views;
}

std::optional<double> meeting_time(const std::vector<View>& views, double duration, const Vector& shift) {
  double from = 0, to = duration;
  for (const View& view : views) {
    restrict_to_overlap(view.a, shifted(view.b, view.axes.transpose() * shift), duration, from, to);
  }
  return from <= to ? std::optional(from) : std::nullopt;
}

}  // namespace strut
