from evenbreak.stats.counts import CountLaw as CountLaw
from evenbreak.stats.exact import exact as exact
