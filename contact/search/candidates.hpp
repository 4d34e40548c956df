// Candidates: the points that a search on this rank knows, and the criterion by which two of them may touch.
#pragma once

#include <cstdint>
#include <vector>

#include "contact/laws/contact_law.hpp"
#include "contact/search/pairs.hpp"

namespace strut::contact {

// A candidate, in the form in which it is sent to other ranks.
struct Candidate {
  double reference[4], current[4];  // of Site
  double mass, skin;                // kg; its skin distance, m
  std::int64_t id;
  int block, owned;    // owned: its local index on the rank that owns it
  std::int64_t owner;  // that rank
};

inline Vector place(const Candidate& c) { return {c.current[0], c.current[1], c.current[2]}; }
inline Vector reference(const Candidate& c) { return {c.reference[0], c.reference[1], c.reference[2]}; }

// Owned points, ascending, then those of other ranks.
struct CandidatePool {
  std::vector<Candidate> members;
  std::size_t owned = 0;

  bool owns(int m) const { return m < static_cast<int>(owned); }
};

// True if two candidates may touch before both have used up their skin distances.
struct Criterion {
  double radius;  // r_c, m
  const BlockPair& blocks;

  bool operator()(const Candidate& a, const Candidate& b) const {
    if (!within_reach(a, b)) return false;
    return !(blocks.one_body && bonded(a.current[3], b.current[3], reference(b) - reference(a)));
  }

  bool within_reach(const Candidate& a, const Candidate& b) const {
    const double apart = (reference(b) - reference(a)).norm();
    const bool anywhere = blocks.by_surfaces && !blocks.one_body;
    const double touching = anywhere ? radius : largest_touching_distance(radius, apart, blocks.one_body);
    const double reach = touching + (a.skin + b.skin);  // the same from both ends
    return (place(b) - place(a)).squaredNorm() <= reach * reach;
  }
};

}  // namespace strut::contact
