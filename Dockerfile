# The page in a container:
#   docker build -t evenbreak .
#   docker run -p 8000:8000 -v events:/events evenbreak --host 192.168.1.20
FROM python:3.13-slim AS build
RUN python -m venv --without-pip /app
COPY . /src
RUN pip wheel --no-cache-dir --no-deps --wheel-dir /wheel /src \
    && pip --python /app/bin/python install --no-cache-dir /wheel/*.whl \
    && find /app -depth -type d -name tests -exec rm -r {} +

FROM python:3.13-slim
RUN useradd --create-home --uid 1000 evenbreak && install -d -o evenbreak /events
COPY --from=build /app /app
USER evenbreak
WORKDIR /events
VOLUME /events
EXPOSE 8000
ENV PATH=/app/bin:$PATH PYTHONUNBUFFERED=1
HEALTHCHECK CMD ["python", "-c", "from urllib.request import urlopen; urlopen('http://127.0.0.1:8000/')"]
ENTRYPOINT ["evenbreak", "serve", "/events/tonight.db", "--lan"]
