from evenbreak.physics.objects import Ball as Ball
from evenbreak.physics.objects import Cloth as Cloth
from evenbreak.physics.objects import Cue as Cue
from evenbreak.physics.objects import Table as Table
