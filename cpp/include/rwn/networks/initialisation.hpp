// How a conventional network starts (thesis section 2.2.2): one file each in initialisation/ and one entry in the list.
#pragma once

#include "rwn/networks/initialisation/dyadic_grid.hpp"
#include "rwn/networks/initialisation/heuristic.hpp"
#include "rwn/networks/initialisation/least_squares.hpp"
#include "rwn/networks/initialisation/selection.hpp"
