"""Markov chains and their stochastic limits; nothing in this package knows about particular games.

A `chain` is read from a game, a graph, arcs or a matrix (`explore`, `matrices`). Its graph shows
which states are left for good and with what period the others recur (`structure`). Its numbers come
from one idea: states are eliminated one after the other, with sums of arcs as pivots, so that
nothing is subtracted. The graph determines the order, and the kernel depends on the numbers:

| what is eliminated | by | for |
|---|---|---|
| a few arcs, in any numbers | `elimination` | floats, decimals, fractions, formulas, scores |
| what remains dense in fractions | `exact`, modulo a prime | `limits`, `lumping` |
| one dense array | `dense_elimination` | `stationary`, and fronts |
| a stack of small graphs | `factorization` | small classes, and families of games (`families`) |
| a class, in fronts | `dissection` | some hundreds of states |
| a line | `birth_death` | closed forms and solves in linear time |
| a class too large for that | `certified` | any approximation, proved afterward |

`factorization` chooses for each class and `transient` watches for underflow. Their two solves,
visits and values, are the basis of `limits`, `absorption`, `passage_times`, `rewards` and
`sensitivity`. The other route, by eigenvectors (`eigenpairs`, `spectrum`), leads to the same limits
and checks them.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
