// Ranks without points take part in everything: all points are on one rank, the others have none.
#include <gtest/gtest.h>

#include "advice/advice.hpp"
#include "output/writers.hpp"
#include "regression/scenes.hpp"

namespace strut::regression {
namespace {

// The scene as it is set up, or with all its points on the last rank.
Scene scene_of(const deck::Deck& deck, const Communicator& world, bool on_one_rank) {
  Scene scene = set_up(deck, world);
  advice(deck, scene);
  if (!on_one_rank) return scene;
  const std::vector<int> ranks(scene.body.owned(), world.size() - 1);
  return set_up_again(deck, migration_state_of(scene, moved(whole_cloud(scene.body.domain), ranks, world)), world);
}

// Number of bonds that an end on this rank holds and the other one, on this rank too, has lost.
int broken_at_one_end(const Domain& domain) {
  int count = 0;
  for (std::size_t i = 0; i < domain.families.broken.size(); ++i) {
    for (const int j : domain.families.broken[i]) {
      if (j < domain.owned) domain.families.for_each(j, [&](int k) { count += k == static_cast<int>(i); });
    }
  }
  return count;
}

// A few steps with frames of all variables and rows of the history. Half of them follow after all has been saved, which
// is where ranks meet that have no part in a group of points, and restored to a scene that is set up anew.
template <class Make, class Advance>
Ledger ledger_of(deck::Deck deck, const Communicator& world, bool on_one_rank, int steps, const Make& make,
                 const Advance& advance) {
  Snapshot snapshot;
  Ledger last;
  for (const bool restored : {false, true}) {
    Scene scene = scene_of(deck, world, on_one_rank);
    deck.output.variables = names_of(observables(scene.body));
    OutputWriters writers(deck, output_variables_of(deck, scene.body, scene.contact));
    auto solver = make(scene);
    const auto pass = [&](Archive archive) {
      solver.serialize(archive);
      writers.serialize(archive, solver.steps(), solver.time());
    };
    if (restored) pass(Archive::loading_from(snapshot));
    writers.open(scene.body);
    for (int step = 0; step < steps / 2; ++step) {
      advance(solver, [&](const auto& reactions) { last = *writers.write(scene.body, solver, reactions, true); });
    }
    EXPECT_EQ(broken_at_one_end(scene.body.domain), 0);
    if (!restored) pass(Archive::saving_to(snapshot));
  }
  return last;
}

Ledger ledger_of(const AnyScene& any, const RunFolder& folder, bool on_one_rank) {
  deck::Deck deck = deck::read(folder.write("deck.xml", any.text()), folder.world);
  deck.output.enabled = deck.history.enabled = true;
  deck.output.file = folder / (on_one_rank ? "one.e" : "all.e");
  deck.history.file = folder / (on_one_rank ? "one.csv" : "all.csv");
  deck.output.frequency = deck.history.frequency = 1;
  deck.history.variables = {"Contact_Force_Z(block_1:block_2)", "Max_Von_Mises_Stress", "Mean_Velocity_Z"};
  const int conditions = static_cast<int>(deck.conditions.size());
  const deck::Solver& times = deck.solver;
  if (any.is_static) {
    const Observer silent{[](const std::string&) {}, {}, [] { return false; }};
    const auto make = [&](Scene& scene) {
      return QuasiStatic(scene.body, std::move(scene.conditions), std::move(scene.contact), *scene.quasi_static,
                         times.initial_time, times.final_time, silent, std::move(scene.fracture));
    };
    return ledger_of(deck, folder.world, on_one_rank, 4, make, [&](QuasiStatic& solver, const auto& write) {
      solver.advance();
      write([&] { return solver.reactions(conditions); });
    });
  }
  const auto make = [&](Scene& scene) {
    CentralDifference solver(scene.body, std::move(scene.conditions), std::move(scene.contact), scene.control,
                             times.initial_time, std::move(scene.fracture));
    solver.gather_reactions(conditions);
    return solver;
  };
  return ledger_of(deck, folder.world, on_one_rank, 20, make, [&](CentralDifference& solver, const auto& write) {
    solver.advance_velocity(times.final_time);
    write([&] { return solver.reactions(); });
    solver.advance_position(true);
  });
}

class EmptyRanks : public testing::TestWithParam<AnyScene> {};

// Energies as on a partition that gives points to all ranks: to round-off explicitly, equilibria to what their
// tolerance of 1e-6 of the forces leaves.
TEST_P(EmptyRanks, TakePartInEverything) {
  const RunFolder folder;
  folder.write("points.txt", points_of_scenes());
  const Ledger all = ledger_of(GetParam(), folder, false), one = ledger_of(GetParam(), folder, true);
  const double tolerance = GetParam().is_static ? 1e-4 : 1e-9;
  EXPECT_GT(all.elastic, 0);
  EXPECT_NEAR(one.elastic, all.elastic, tolerance * all.elastic);
  EXPECT_NEAR(one.dissipated, all.dissipated, tolerance * (all.elastic + all.dissipated));
  EXPECT_NEAR(one.kinetic, all.kinetic, tolerance * all.kinetic);
}

INSTANTIATE_TEST_SUITE_P(Scenes, EmptyRanks, testing::ValuesIn(all_scenes()),
                         [](const auto& scene) { return scene.param.name; });

}  // namespace
}  // namespace strut::regression
