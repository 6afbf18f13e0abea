from .published import Erratum as Erratum
from .published import PublishedNumber as PublishedNumber
from .published import errata as errata
from .published import physics_errata as physics_errata
from .published import physics_numbers as physics_numbers
from .published import published_numbers as published_numbers
from .reproduce import reproduction as reproduction
