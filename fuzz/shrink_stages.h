// The stages that make a spec smaller, in the order in which they are run. Earlier ones make the motions shorter that
// later ones generate.
#pragma once

namespace contort {

class ShrinkState;

// Only what moved in the worst frame a part that the subject names, else only what moved then, else only what had
// begun.
void cut_time(ShrinkState& state);

// Everything around the actions as it is by default, in one step: parts, surroundings, dynamics.
void try_stock(ShrinkState& state);

// Delta debugging over sequences, clips, actions and so on, from coarse to fine.
void remove_structure(ShrinkState& state);

// Lets interrupts take their turn in the queue, alone or last: most failures do not ask how their motion began.
void queue_interrupts(ShrinkState& state);

// Delta debugging over all fields that are not at their defaults.
void reset_fields(ShrinkState& state);

// Towards their defaults, by bisection over values of two digits.
void lower_numbers(ShrinkState& state);

// Tries edits that only work together: two fields, two actions, two clips made one. Ends with the first that holds.
void try_pairs(ShrinkState& state);

}  // namespace contort
