// The checks of contact, and of what passes through what: bodies, tools and planes.
#include <algorithm>
#include <cmath>
#include <iomanip>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "conditions/crossing.hpp"
#include "contact/interpenetration.hpp"
#include "run/monitor.hpp"

namespace strut {

void Monitor::check_interpenetration(double time, const contact::Contact& contact) {
  if (!contact.any() || limits_.interpenetration >= 1 || is_silent(interpenetration) || time < next_interpenetration_)
    return;
  next_interpenetration_ = time + pause();
  const auto found = contact::find_interpenetration(body_.domain, contact, limits_.interpenetration);
  if (!found) return;
  std::string text;
  if (found->point >= 0) {
    const std::vector<std::string>& names = body_.domain.cloud.block_names;
    text = text_of(at(time), "blocks ", names[found->first], " and ", names[found->second],
                   " pass through each other: ", found->points, " points, ", 100 * found->part,
                   " % of the smaller one, are inside the other (Watch > Passing): ", locate(body_, found->point),
                   ". Likely causes: contact too soft for the speed or the load",
                   contact.by_surfaces(found->first, found->second) ? " (Stiffness Factor, Largest Overlap)"
                                                                    : ", a Contact Radius far below the spacing");
  }
  passed(interpenetration, text);
}

// Springs in series have one force, so each has the part of the shortening that it has of the stored energy. In a
// body that flows contact has up to twice that part.
void Monitor::check_soft_contact(const Ledger& ledger, const contact::Contact& contact, bool last, Steps steps) {
  constexpr double slow = 0.05;          // kinetic over internal energy: as users of explicit finite elements accept
  constexpr double worth_saying = 0.05;  // of the shortening; warnings of thin members begin there, too
  if (!contact.any()) return;
  const double stored = body_.domain.communicator.sum(contact.energy_of_surfaces());
  const double internal = stored + ledger.elastic + ledger.dissipated + ledger.stabilization;
  if (stored > most_in_contact_ && ledger.kinetic <= slow * internal)
    most_in_contact_ = stored, part_in_contact_ = stored / internal;
  if (!last || !(part_in_contact_ > worth_saying && most_in_contact_ > worth_a_warning * ledger.largest)) return;
  const double stiffer = part_in_contact_ / (1 - part_in_contact_) * (1 - worth_saying) / worth_saying;
  warn(
      soft_contact,
      text_of(std::setprecision(2), "contact between surfaces held up to ", 100 * part_in_contact_,
              " % of the energy that it and the bodies took up: it gives way by so much of the shortening, and elastic "
              "bodies that press on each other are too soft by it. For 5 % expected ",
              steps == Steps::of_load ? "" : "a finer mesh, or equilibria (Solver > QuasiStatic) with ",
              "a Stiffness Factor ", stiffer, " times as large (Contact > Models)"));
}

void Monitor::check_undeclared(double time, const contact::Contact& contact) {
  if (warned_[undeclared] || time < next_undeclared_) return;
  next_undeclared_ = time + costly * pause();
  const auto found = contact::find_undeclared(body_.domain, contact);
  if (!found) return;
  if (found->point < 0) return warn_once(undeclared, "");
  const std::string &first = body_.domain.cloud.block_names[found->first],
                    &second = body_.domain.cloud.block_names[found->second];
  const std::string bodies =
      found->first == found->second
          ? "block " + first + " passes through itself, for the deck declares no contact of it with itself: "
          : "blocks " + first + " and " + second +
                " pass through each other, for the deck declares no contact between them: ";
  warn_once(undeclared,
            text_of(at(time), bodies, found->points,
                    " points are inside of material that was elsewhere: ", locate(body_, found->point),
                    ". Expected: Contact > Interactions > 'Self Contact' for bodies that fold, 'General Contact' for "
                    "bodies that meet"));
}

void Monitor::check_tools(double time, const Conditions& conditions, const std::vector<ToolOfScene>& tools,
                          Steps steps) {
  if (time < next_tools_) return;
  next_tools_ = time + pause();
  if (!warned_[beyond_plane]) check_planes(time);
  if (tools.empty()) return;
  if (!warned_[beyond_tool]) check_sets_of_tools(time, conditions, tools);
  if (!warned_[meeting]) check_meeting(time, conditions, tools);
  if (warned_[crossing]) return;
  const std::vector<Vector> places = present_positions(body_.domain);
  std::size_t n = 0;
  conditions.visit([&](const RigidTool& tool) {
    const std::string& name = tools[n++].name;
    if (warned_[crossing] || std::holds_alternative<HalfSpace>(tool.shape)) return;
    const auto found = find_crossing(tool, time, body_.domain, places);
    if (!found) return;
    if (found->point < 0) return warn_once(crossing, "");
    warn_once(crossing,
              text_of(at(time), "the tool '", name,
                      "' stands between points that are bonded to each other: ", locate(body_, found->point),
                      ". Tools stop points only, and one that is thinner than 1.5 spacings, or an edge of it, passes "
                      "between them",
                      steps == Steps::of_load ? ", as does one that goes too far in a load step; expected more load "
                                                "steps, "
                                              : "; expected ",
                      "a finer mesh or a thicker tool"));
  });
}

namespace {

// Collective. How many points of all ranks have gone through a surface, and one of them; −1 on other ranks.
struct Passed {
  double points = 0;
  int one = -1;
};

// `gap`(point, place): how far a place is in front of the surface, m, with the surface where it was in the mesh or, of
// the present place, where it is now. Points have gone through if they were in front and are half a spacing behind.
Passed passed_points(const Domain& domain, const auto& gap_in_mesh, const auto& gap_now) {
  Passed passed;
  for (int i = domain.owned; i-- > 0;) {
    const double h = domain.cloud.spacings[i];
    if (gap_in_mesh(i) > on_plane * h && gap_now(i) < -0.5 * h) ++passed.points, passed.one = i;
  }
  passed.points = domain.communicator.sum(passed.points);
  if (domain.communicator.first_rank(passed.one >= 0) != domain.communicator.rank()) passed.one = -1;
  return passed;
}

}  // namespace

// Nothing but bonds across it keeps a body in front of a plane behind which its mirror image is.
void Monitor::check_planes(double time) {
  const Domain& domain = body_.domain;
  for (const Mirror& mirror : domain.mirrors) {
    const auto side = [&](int i) { return mirror.distance(domain.reference(i)) < 0 ? -1 : 1; };
    const Passed passed = passed_points(
        domain, [&](int i) { return std::abs(mirror.distance(domain.reference(i))); },
        [&](int i) { return side(i) * mirror.distance(domain.current(i)); });
    if (passed.points == 0) continue;
    if (passed.one < 0) return warn_once(beyond_plane, "");
    const bool is_mirrored = std::ranges::any_of(domain.mirrors, [&](const Mirror& other) {
      return other.number == mirror.number && other.body == domain.body_of(passed.one);
    });
    return warn_once(
        beyond_plane,
        text_of(at(time), "points have gone through a Symmetry Plane, ", passed.points, " by now, as ",
                locate(body_, passed.one),
                is_mirrored
                    ? ". Contact does not see mirror images; expected a Rigid Plane there too, or the whole body"
                    : ", whose body has no mirror image: right if this body is whole; if the scene is half of a "
                      "symmetric one, expected a Rigid Plane there"));
  }
}

void Monitor::check_sets_of_tools(double time, const Conditions& conditions, const std::vector<ToolOfScene>& tools) {
  const Domain& domain = body_.domain;
  std::size_t n = 0;
  conditions.visit([&](const RigidTool& tool) {
    const std::string& name = tools[n++].name;
    const bool has_all = !domain.communicator.any(static_cast<int>(tool.points.size()) < domain.owned);
    if (warned_[beyond_tool] || has_all) return;
    std::vector<char> stopped(domain.owned, 0);
    for (const int i : tool.points) stopped[i] = 1;
    const Vector offset = tool.offset(time);
    const auto gap = [&](const Vector& place) { return surface(tool.shape, tool.nearest_image(domain, place)).gap; };
    const Passed passed = passed_points(
        domain, [&](int i) { return stopped[i] ? 0 : gap(domain.reference(i)); },
        [&](int i) { return gap(domain.current(i) - offset); });
    if (passed.points == 0) return;
    if (passed.one < 0) return warn_once(beyond_tool, "");
    warn_once(
        beyond_tool,
        text_of(at(time), "the tool '", name,
                "' stops the points of its Node Set only: others have gone through its surface, ", passed.points,
                " by now, as ", locate(body_, passed.one),
                ". Expected no Node Set, one of all points that may meet it, or a Rigid Box if the surface ends"));
  });
}

// Tools that overlap at the start are allowed to, e.g. two plates of one punch.
void Monitor::check_meeting(double time, const Conditions& conditions, const std::vector<ToolOfScene>& tools) {
  const std::vector<RigidTool> all = tools_of(conditions);
  overlapped_.resize(all.size() * all.size(), 0);
  for (std::size_t n = 0; n < all.size(); ++n) {
    for (std::size_t m = 0; m < n; ++m) {
      if (!may_meet(all[m], all[n])) continue;
      const bool overlap = gap_between(all[m], all[n], time) < 0;
      std::uint8_t& before = overlapped_[n * all.size() + m];
      if (overlap && before == apart) {
        warn(meeting, at(time) + "the tools '" + tools[m].name + "' and '" + tools[n].name +
                          "' pass through each other: tools stop points only, and nothing is between them; expected "
                          "material there, or an end before (Final Time)");
      }
      if (before == 0) before = overlap ? together : apart;
    }
  }
}

}  // namespace strut
