// How a conventional network starts (thesis section 2.2.2): one file each in initialisation/ and one entry in the list.
#pragma once

#include "rwn/initialisation/dyadic_grid.hpp"
#include "rwn/initialisation/heuristic.hpp"
#include "rwn/initialisation/least_squares.hpp"
#include "rwn/initialisation/selection.hpp"
