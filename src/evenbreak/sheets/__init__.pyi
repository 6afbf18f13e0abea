from .pdf_page import pdf_bytes as pdf_bytes
from .pdf_page import usual_paper as usual_paper
from .pdf_sheet import sheet_pages as sheet_pages
from .pdf_sheet import sheet_pdf as sheet_pdf
from .sheet_page import round_html as round_html
from .sheet_page import sheet_html as sheet_html
from .workbook import report_tables as report_tables
from .workbook import workbook_bytes as workbook_bytes
