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

// To an archive and back, which is where ranks meet that have no part in a group of points.
template <class Solver>
void save_and_restore(Solver& solver, OutputWriters& writers) {
  Snapshot snapshot;
  Archive saves = Archive::saving_to(snapshot), restores = Archive::loading_from(snapshot);
  for (Archive* archive : {&saves, &restores}) {
    solver.serialize(*archive);
    writers.serialize(*archive, solver.steps(), solver.time());
  }
}

// A few steps with frames of all variables and rows of the history; half of them after all has been restored.
Ledger ledger_of(const AnyScene& any, const RunFolder& folder, bool on_one_rank) {
  deck::Deck deck = deck::read(folder.write("deck.xml", any.text()), folder.world);
  Scene scene = scene_of(deck, folder.world, on_one_rank);
  deck.output.enabled = deck.history.enabled = true;
  deck.output.file = folder / (on_one_rank ? "one.e" : "all.e");
  deck.history.file = folder / (on_one_rank ? "one.csv" : "all.csv");
  deck.output.frequency = deck.history.frequency = 1;
  deck.output.variables = names_of(observables(scene.body));
  deck.history.variables = {"Contact_Force_Z(block_1:block_2)", "Max_Von_Mises_Stress", "Mean_Velocity_Z"};
  OutputWriters writers(deck, output_variables_of(deck, scene.body, scene.contact));
  writers.open(scene.body);
  const auto write = [&](auto& solver, const Reactions& reactions) {
    writers.write(
        scene.body, solver, [&] { return reactions; }, true);
  };
  if (any.is_static) {
    const Observer silent{[](const std::string&) {}, {}, [] { return false; }};
    QuasiStatic solver(scene.body, std::move(scene.conditions), std::move(scene.contact), *scene.quasi_static,
                       deck.solver.initial_time, deck.solver.final_time, silent, std::move(scene.fracture));
    for (int step = 0; step < 4; ++step) {
      solver.advance();
      write(solver, solver.reactions(static_cast<int>(deck.conditions.size())));
      if (step == 1) save_and_restore(solver, writers);
    }
    return solver.ledger();
  }
  CentralDifference solver(scene.body, std::move(scene.conditions), std::move(scene.contact), scene.control,
                           deck.solver.initial_time, std::move(scene.fracture));
  solver.gather_reactions(static_cast<int>(deck.conditions.size()));
  for (int step = 0; step < 20; ++step) {
    solver.advance_velocity(deck.solver.final_time);
    write(solver, solver.reactions());
    solver.advance_position(true);
    if (step == 10) save_and_restore(solver, writers);
  }
  solver.advance_velocity(deck.solver.final_time);
  return solver.ledger();
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
