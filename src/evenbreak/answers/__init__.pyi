from .fair_pairs import RaceLimits as RaceLimits
from .fair_pairs import find_players as find_players
from .fair_pairs import matchups_frame as matchups_frame
from .fair_pairs import most_active as most_active
from .frames import ratings_frame as ratings_frame
from .frames import summary_frame as summary_frame
from .rating_changes_frame import moves_frame as moves_frame
from .rating_changes_frame import moves_of_files as moves_of_files
