from evenbreak.handicaps.fair import FairRace as FairRace
from evenbreak.handicaps.fair import fair_races as fair_races
