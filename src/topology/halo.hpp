// Exchange of values of points that other ranks own, while this rank works on points that need none of them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "topology/mirror.hpp"

namespace strut {

class Communicator;

// The part of a material point that its neighbors read.
// A bond or a contact reads it of its far end: one cache line. Four lanes each, so that a vector and a scalar
// are loaded together.
struct alignas(64) Site {
  Eigen::Array4d reference;  // X (m), V (m³)
  Eigen::Array4d current;    // y (m), δ (m)

  double volume() const { return reference[3]; }
  double horizon() const { return current[3]; }
};

inline void reflect_position(const Reflection& by, Vector& place) { place = by(place); }
inline void reflect_direction(const Reflection& by, Vector& direction) { direction = (by.turn * direction).eval(); }

// For values that are equal on an image and its original.
inline constexpr auto unchanged = [](const Reflection&, auto&) {};

// A ghost that is an image; `original`: local index if this rank owns the original, else −1.
struct ImagePoint {
  int ghost, original;
  Reflection by;
};

// The halo exchange, built on Tpetra's distributor.
class Halo {
 public:
  // Collective. `owned`, `ghosts`: global ids in the order of local indices (ghosts follow the owned points);
  // `owners`: the ranks that own the ghosts, or the originals of images. Each of these must own the id, or that of the
  // original.
  Halo(const Communicator& communicator, std::span<const std::int64_t> owned, std::span<const std::int64_t> ghosts,
       std::span<const int> owners, const Images& images = {});
  // Collective. The exchange for the points marked in `wanted` (owned points and ghosts, marked as on their owners).
  Halo restricted_to(const Communicator& communicator, const std::vector<std::uint8_t>& wanted) const;
  ~Halo();
  Halo(Halo&&) noexcept;
  Halo& operator=(Halo&&) noexcept;

  // Exchanges values of owned points and ghosts, of any type that owns no memory: they are copied as bytes. start()
  // sends the values of the owned points that other ranks need; finish() with the same values waits and fills the
  // ghosts. One exchange at a time. The value of an image is that of its original after reflect(by, value); plain
  // numbers are not changed.
  template <class Value>
  void start(const std::vector<Value>& values) const {
    static_assert(std::is_trivially_destructible_v<Value>, "it owns what is elsewhere");
    start(values.data(), sizeof(Value), sizeof(Value));
  }
  template <class Value>
  void finish(std::vector<Value>& values) const {
    finish(values.data(), sizeof(Value), sizeof(Value), [](const Reflection& by, void* value) {
      if constexpr (!std::is_arithmetic_v<Value> && !std::is_enum_v<Value>) reflect(by, *static_cast<Value*>(value));
    });
  }
  template <class Value>
  void exchange(std::vector<Value>& values) const {
    start(values);
    finish(values);
  }

  // The same with the reflection `reflected`: the type Vector does not show whether it is a position or a direction.
  template <auto reflected, class Value>
  void exchange(std::vector<Value>& values) const {
    start(values);
    finish(values.data(), sizeof(Value), sizeof(Value), by_value<reflected, Value>);
  }

  // The same for the present positions of the sites alone, or for directions that are stored instead of them.
  void start_positions(const std::vector<Site>& sites) const { start(place(sites), sizeof(Site), sizeof(Vector)); }
  template <auto reflected = reflect_position>
  void finish_positions(std::vector<Site>& sites) const {
    finish(const_cast<void*>(place(sites)), sizeof(Site), sizeof(Vector), by_value<reflected, Vector>);
  }
  void exchange_positions(std::vector<Site>& sites) const {
    start_positions(sites);
    finish_positions(sites);
  }

  const std::vector<ImagePoint>& images() const;

  // The present stretch of the periods along x, y, z, which places of images follow; shared with restricted_to().
  void set_stretch(const Vector& stretch);
  const Vector& stretch() const;

 private:
  // Turns the value of an original into that of its image, in place.
  using Reflect = void (*)(const Reflection& by, void* value);
  template <auto reflected, class Value>
  static void by_value(const Reflection& by, void* value) {
    reflected(by, *static_cast<Value*>(value));
  }
  static const void* place(const std::vector<Site>& sites) { return sites.empty() ? nullptr : &sites[0].current; }

  // `width` bytes for each point, `stride` bytes from one to the next.
  void start(const void* first, std::size_t stride, std::size_t width) const;
  void finish(void* first, std::size_t stride, std::size_t width, Reflect reflect) const;

  struct Plan;
  explicit Halo(std::unique_ptr<Plan> plan);
  std::unique_ptr<Plan> plan_;
};

}  // namespace strut
