// The stages that make a spec smaller, in the order in which they are run. Earlier ones make the motions shorter that
// later ones generate.
#pragma once

namespace contort {

class ShrinkState;

// Keeps only the actions that moved a part of the subject in the worst frame. If the failure then does not show, it
// keeps the actions that moved any part in that frame, or else those that had begun.
void cut_time(ShrinkState& state);

// Sets everything around the actions to its default in one step: parts, surroundings, dynamics.
void try_stock(ShrinkState& state);

// Delta debugging over sequences, clips, actions and so on, from coarse to fine.
void remove_structure(ShrinkState& state);

// Moves an interrupt's sequence into the queue, alone or last, because most failures do not depend on how their motion
// began.
void queue_interrupts(ShrinkState& state);

// Delta debugging over all fields that are not at their defaults.
void reset_fields(ShrinkState& state);

// Moves numbers towards their defaults, by bisection over values of two digits.
void lower_numbers(ShrinkState& state);

// Tries edits that only work together: two fields, two actions, two clips made one. Ends with the first edit that keeps
// the failure.
void try_pairs(ShrinkState& state);

}  // namespace contort
