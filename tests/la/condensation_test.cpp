#include "core/la/condensation.hpp"

#include <catch2/catch.hpp>

using namespace vocalis::la;

// A = [2 1 0; 1 0 3; 0 4 5]; the second unknown is kept: A_kk = 0, A_ee = diag(2, 5), A_ke = (1, 3), A_ek = (1, 4).
TEST_CASE("what is eliminated leaves its Schur complement, and comes back from what is kept") {
  const int kept[] = {1};
  Condensation condensation({3, {0, 0, 1, 1, 2, 2}, {0, 1, 0, 2, 1, 2}}, kept);
  REQUIRE(condensation.factorise({{2, 1, 1, 3, 4, 5}}));
  CHECK(condensation.kept_matrix()[0] == Approx(-1.0 / 2 - 3.0 * 4 / 5));
  // x = (1, 2, 3): b = (4, 10, 23)
  const double load[] = {4, 10, 23};
  const auto left = condensation.condense(load);
  CHECK(left[0] == Approx(10 - 4.0 / 2 - 3 * 23.0 / 5));
  left[0] /= condensation.kept_matrix()[0];
  CHECK(left[0] == Approx(2));
  const auto solution = condensation.expand();
  CHECK(solution[0] == Approx(1));
  CHECK(solution[2] == Approx(3));
}

TEST_CASE("with nothing kept the whole is solved") {
  Condensation condensation({2, {0, 0, 1}, {0, 1, 1}}, {});
  REQUIRE(condensation.factorise({{2, 1, 4}}));
  const double load[] = {5, 12};
  CHECK(condensation.condense(load).empty());
  const auto solution = condensation.expand();
  CHECK(solution[0] == Approx(1));
  CHECK(solution[1] == Approx(3));
}

TEST_CASE("what cannot be eliminated is told") {
  const int kept[] = {1};
  Condensation condensation({3, {0, 0, 1, 1, 2, 2}, {0, 1, 0, 2, 1, 2}}, kept);
  CHECK_FALSE(condensation.factorise({{0, 1, 1, 3, 4, 5}}));
  CHECK(condensation.factorise({{2, 1, 1, 3, 4, 5}}));
}
