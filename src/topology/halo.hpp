// Values of points that other ranks own: sent and received while this rank works on points that need none of them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "topology/mirror.hpp"
#include "topology/site.hpp"

namespace strut {

class Communicator;

inline void reflect_place(const Reflection& by, Vector& place) { place = by(place); }
inline void reflect_direction(const Reflection& by, Vector& direction) { direction = (by.turn * direction).eval(); }

// For values that an image has as its original does.
inline constexpr auto unchanged = [](const Reflection&, auto&) {};

// A ghost that is an image by symmetry planes, and its original where that is this rank's own; −1: another's.
struct ImagePoint {
  int ghost, original;
  Reflection by;
};

// Built on Tpetra's distributor.
class Halo {
 public:
  // Collective. `owned`, `ghosts`: global ids in the order of local indices (ghosts follow the owned points); `owners`:
  // the ranks that own the ghosts, or the originals of those that are images. Each of these must know the id, or the
  // original's, as one of its own.
  Halo(const Communicator& communicator, std::span<const std::int64_t> owned, std::span<const std::int64_t> ghosts,
       std::span<const int> owners, const Images& images = {});
  // Collective. The same for some of the points: `wanted` of owned points and ghosts, as their owners have it.
  Halo restricted_to(const Communicator& communicator, const std::vector<std::uint8_t>& wanted) const;
  ~Halo();
  Halo(Halo&&) noexcept;
  Halo& operator=(Halo&&) noexcept;

  // Values of owned points and of ghosts, of any type that can be copied byte by byte. Sends those of the owned points
  // that other ranks need. One exchange at a time; finish() with the same values waits and fills the ghosts. An image
  // takes reflect(by, value) of its original's value, or a number as it is.
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

  // With another function of that kind; a Vector does not say by itself whether it is a place or a direction.
  template <auto reflected, class Value>
  void exchange(std::vector<Value>& values) const {
    start(values);
    finish(values.data(), sizeof(Value), sizeof(Value), by_value<reflected, Value>);
  }

  // The same for present places alone, or for directions in their place.
  void start_places(const std::vector<Site>& sites) const { start(place(sites), sizeof(Site), sizeof(Vector)); }
  template <auto reflected = reflect_place>
  void finish_places(std::vector<Site>& sites) const {
    finish(const_cast<void*>(place(sites)), sizeof(Site), sizeof(Vector), by_value<reflected, Vector>);
  }
  void exchange_places(std::vector<Site>& sites) const {
    start_places(sites);
    finish_places(sites);
  }

  const std::vector<ImagePoint>& images() const;

  std::int64_t bytes_sent() const { return bytes_sent_; }  // since the start, by this rank

 private:
  // Makes the value of an image from its original's, in place.
  using Reflect = void (*)(const Reflection& by, void* value);
  template <auto reflected, class Value>
  static void by_value(const Reflection& by, void* value) {
    reflected(by, *static_cast<Value*>(value));
  }
  static const void* place(const std::vector<Site>& sites) { return sites.empty() ? nullptr : &sites[0].current; }

  // `width` bytes of each point, `stride` bytes from one to the next.
  void start(const void* first, std::size_t stride, std::size_t width) const;
  void finish(void* first, std::size_t stride, std::size_t width, Reflect reflect) const;

  struct Plan;
  explicit Halo(std::unique_ptr<Plan> plan);
  std::unique_ptr<Plan> plan_;
  mutable std::int64_t bytes_sent_ = 0;
};

}  // namespace strut
