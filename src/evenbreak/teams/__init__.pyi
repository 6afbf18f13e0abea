from .matrix_games import MatrixGame as MatrixGame
from .matrix_games import matrix_game as matrix_game
from .night import TeamNight as TeamNight
from .order import order_of as order_of
from .solve import SolvedNight as SolvedNight
from .solve import solved as solved
from .squad import Cap as Cap
from .squad import Squad as Squad
