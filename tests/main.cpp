#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

#include "core/base/session.hpp"

int main(int argc, char** argv) {
  const vocalis::base::Session session(argc, argv);
  return Catch::Session().run(argc, argv);
}
