// SPDX-License-Identifier: GPL-3.0-or-later
//
// The generated CAD parts are sound, and remeshing one moves its surface by no more than its
// facets.
#include "cad_meshes.h"
#include "invariants.h"
#include "sampled_distance.h"

#include <gtest/gtest.h>

namespace {

using namespace surety::test;

TEST(Cad_meshes, are_sound_and_have_one_handle_a_hole)
{
  EXPECT_TRUE(is_sound(cad_part()));
  EXPECT_EQ(euler_characteristic(cad_part()), 0);
  EXPECT_TRUE(is_sound(crossed_blocks()));
  EXPECT_EQ(euler_characteristic(crossed_blocks()), 2);
  EXPECT_EQ(number_of_self_intersections(cad_part()), 0u);
}

TEST(Cad_meshes, remeshed_ones_are_the_same_solid)
{
  const Mesh part = cad_part(), fine = remeshed(part, 0.1);
  EXPECT_GT(fine.number_of_faces(), 10 * part.number_of_faces());
  EXPECT_TRUE(is_sound(fine));
  EXPECT_TRUE(have_same_topology(part, fine));
  EXPECT_EQ(number_of_self_intersections(fine), 0u);
  EXPECT_LT(sampled_distance(part, fine), 0.02);
}

} // namespace
